# SPDX-License-Identifier: MIT
"""The workflow builds what a release holds, by versions that stay the same."""

import re
import unittest

import fake_repository
from addon_files import PLATFORMS

TEXT = (fake_repository.ROOT / ".github" / "workflows" / "ci.yml").read_text(encoding="utf-8")


def built_platforms():
    """The platforms of the rows of the workflow, as the `.gdextension` names them."""
    found = set()
    for system, arguments in re.findall(r"arguments: platform=(\w+) ([^}\n]*)", TEXT):
        values = dict(part.split("=") for part in arguments.split())
        parts = [system] + (["threads"] if values.get("threads") == "yes" else []) + [values["arch"]]
        found.add(".".join(part for part in parts if part != "universal"))
    return found


class WorkflowTest(unittest.TestCase):
    def test_it_builds_every_platform_of_a_release(self):
        self.assertEqual(built_platforms(), set(PLATFORMS))

    def test_it_builds_debug_and_release_of_each(self):
        for build in ("template_debug", "template_release"):
            self.assertEqual(len(re.findall(rf"scons target={build} \$\{{\{{ matrix.arguments \}}\}}", TEXT)), 2)

    def test_versions_are_pinned(self):
        for used in re.findall(r"uses: (\S+)", TEXT):
            self.assertRegex(used, r"@v\d+\.\d+\.\d+$|^mymindstorm/setup-emsdk@v14$")
        self.assertNotIn("-latest", TEXT)
        for image in re.findall(r"container: (\S+)", TEXT):
            self.assertRegex(image, r":\d+\.\d+$")

    def test_macos_is_signed_and_the_package_judged(self):
        self.assertIn("codesign --force --sign -", TEXT)
        packing = TEXT[TEXT.index("\n  package:"):]
        self.assertIn("check_package.py", packing)
        self.assertIn("check_versions.py", packing)
        self.assertNotIn("--partial", packing)

    def test_nothing_is_packed_that_was_not_tested(self):
        needed = re.search(r"\n  package:\n.*\n    needs: \[([^\]]*)\]", TEXT)[1]
        self.assertLessEqual({"test", "build-gcc", "build", "engine", "same-bits"}, set(needed.split(", ")))


if __name__ == "__main__":
    unittest.main()
