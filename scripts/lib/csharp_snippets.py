# SPDX-License-Identifier: MIT
"""Writes every C# example of a page as one file that can be compiled.

Usage: csharp_snippets.py PAGE.md OUTPUT.cs
An example with a `using` is a file's text as it stands. Any other one becomes a method that knows `body`, a SoftBody2D, and the nodes
`node` and `other`."""

import re
import sys
from pathlib import Path

BLOCK = re.compile(r"^```csharp\n(.*?)^```", re.MULTILINE | re.DOTALL)


def main():
    blocks = BLOCK.findall(Path(sys.argv[1]).read_text(encoding="utf-8"))
    if not blocks:
        sys.exit(f"{sys.argv[1]} has no example in C#")
    wholes = [re.sub(r"^using .*\n", "", block, flags=re.MULTILINE) for block in blocks if block.startswith("using ")]
    methods = []
    for number, block in enumerate(block for block in blocks if not block.startswith("using ")):
        # The first declares the body that the others go on with.
        taken = "Node node, Node other" + ("" if "SoftBody2D body =" in block else ", SoftBody2D body")
        methods.append(f"static void Example{number}({taken})\n{{\n{block}}}\n")
    text = "using Godot;\nusing SoftBodies;\n\n" + "\n".join(wholes) + "\nstatic class Examples\n{\n" + "\n".join(methods) + "}\n"
    Path(sys.argv[2]).write_text(text, encoding="utf-8")


main()
