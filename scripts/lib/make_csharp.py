# SPDX-License-Identifier: MIT
"""Makes the typed C# classes of the addon from the class reference.

Usage: make_csharp.py [--check] REPOSITORY
Writes addons/soft_body_2d/csharp/*.g.cs, from doc_classes/*.xml alone. With --check it writes nothing and fails if a file differs
from what it would write."""

import argparse
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

TARGET = Path("addons/soft_body_2d/csharp")
# Picker is a part of SoftBody2D that no script makes.
LEFT_OUT = {"SoftBodyPicker"}
SINGLETONS = {"SoftBodySimulation2D"}
# What a wrapper calls the object that it stands for, by the class that the engine knows.
HOLDERS = {"Node2D": "Node", "Area2D": "Node", "Polygon2D": "Node", "Resource": "Resource", "RefCounted": "Instance"}
# Words of C# that our parameters use.
KEYWORDS = {"base", "event", "object", "params", "lock"}
# The class reference knows one whole number; in C# a mask has no sign, and these need more than 32 bits.
UNSIGNED = {"collision_layer", "collision_mask"}
LONG = {"hash_state", "get_tick_count"}

# C# type, and how a Variant is read as it.
PLAIN = {
    "bool": ("bool", "AsBool()"),
    "int": ("int", "AsInt32()"),
    "long": ("long", "AsInt64()"),
    "uint": ("uint", "AsUInt32()"),
    "float": ("double", "AsDouble()"),
    "String": ("string", "AsString()"),
    "Vector2": ("Vector2", "AsVector2()"),
    "Vector2i": ("Vector2I", "AsVector2I()"),
    "Transform2D": ("Transform2D", "AsTransform2D()"),
    "Color": ("Color", "AsColor()"),
    "RID": ("Rid", "AsRid()"),
    "NodePath": ("NodePath", "AsNodePath()"),
    "Dictionary": ("Godot.Collections.Dictionary", "AsGodotDictionary()"),
    "Object": ("GodotObject", "AsGodotObject()"),
    "PackedByteArray": ("byte[]", "AsByteArray()"),
    "PackedInt32Array": ("int[]", "AsInt32Array()"),
    "PackedFloat32Array": ("float[]", "AsFloat32Array()"),
    "PackedStringArray": ("string[]", "AsStringArray()"),
    "PackedVector2Array": ("Vector2[]", "AsVector2Array()"),
    "PackedColorArray": ("Color[]", "AsColorArray()"),
}
ENGINE_CLASSES = {"Curve", "InputEvent", "Node", "Node2D", "PhysicsMaterial", "PhysicsShapeQueryParameters2D", "Texture2D", "World2D"}


def pascal(name):
    return "".join(part[:1].upper() + part[1:] for part in name.lower().split("_"))


def camel(name):
    text = pascal(name)
    text = text[:1].lower() + text[1:]
    return "@" + text if text in KEYWORDS else text


def summary_of(element):
    """The first sentence of a description, as XML for C#."""
    found = element.find("description") if element.tag in ("method", "signal") else element
    text = " ".join(((found.text if found is not None else "") or "").split())
    if element.tag == "class":
        text = " ".join(element.findtext("brief_description").split())
    text = re.sub(r"\[codeblock\].*?\[/codeblock\]", "", text)
    text = re.split(r"(?<=[^.][.:]) (?=[A-Z])", text)[0]
    text = re.sub(r"&", "&amp;", text).replace("<", "&lt;").replace(">", "&gt;")
    text = re.sub(r"\[(?:method|member|signal|constant|param|enum) ([\w.]+)\]", r"<c>\1</c>", text)
    text = re.sub(r"\[code\](.*?)\[/code\]", r"<c>\1</c>", text)
    text = re.sub(r"\[/?[ib]\]", "", text)
    return re.sub(r"\[([A-Z]\w*)\]", r"<c>\1</c>", text)


class Types:
    """What a type of the class reference is in C#, from within one class."""

    def __init__(self, classes):
        self.classes = classes
        self.members = {name: {pascal(m.get("name")) for m in root.iter("member")} for name, root in classes.items()}

    def enum_name(self, owner, enum):
        """As Godot's own generator has it: Enum is appended where a property has the name."""
        return enum + "Enum" if enum in self.members[owner] else enum

    def enum(self, inside, full):
        owner, _, name = full.rpartition(".")
        if not owner:
            return full
        return self.enum_name(owner, name) if owner == inside else f"{owner}.{self.enum_name(owner, name)}"

    def of(self, inside, kind, enum=None, name=""):
        """(C# type, expression of a Variant called {0})."""
        if enum:
            made = self.enum(inside, enum)
            return made, f"({made}){{0}}.AsInt32()"
        if kind == "int":
            kind = "uint" if name in UNSIGNED else "long" if name in LONG else "int"
        if kind in PLAIN:
            made, reads = PLAIN[kind]
            return made, "{0}." + reads
        if kind in self.classes:
            return kind, f"{kind}.From({{0}}.AsGodotObject())"
        if kind in ENGINE_CLASSES:
            return kind, f"({kind}){{0}}.AsGodotObject()"
        if kind.endswith("[]"):
            element, reads = self.of(inside, kind[:-2])
            return element.replace("[]", "[][]") if "[]" in element else f"{element}[]", f"Native.Items({{0}}, item => {reads.format('item')})"
        sys.exit(f"make_csharp.py knows no C# type for {kind} in {inside}.{name}: add it")

    def to_variant(self, kind, enum, value):
        """A C# value as what Set and Call take."""
        if enum:
            return f"(long){value}"
        if kind in self.classes:
            return f"{value} == null ? null : {value}.{holder_of(self.classes, self.classes[kind])}"
        if kind in ("NodePath[]", "PackedVector2Array[]"):
            return f"Native.ArrayOf({value})"
        return value


def engine_base(classes, root):
    """The nearest class of the engine that a class descends from."""
    base = root.get("inherits")
    return engine_base(classes, classes[base]) if base in classes else base


def holder_of(classes, root):
    return HOLDERS[engine_base(classes, root)]


def default_of(types, inside, param):
    """(default in the signature, expression in the body) of a parameter, or (None, its name)."""
    given, kind, name = param.get("default"), param.get("type"), camel(param.get("name"))
    value = types.to_variant(kind, param.get("enum"), name)
    if given is None:
        return None, value
    if kind in ("float", "int", "bool"):
        return given, value
    if given == "Vector2(0, 0)":
        return "default", value
    if given == "null":
        return "null", value
    made = types.of(inside, kind)[0]
    if kind == "Vector2":
        return "null", f"{name} ?? new {given}"
    if kind == "NodePath" and given == 'NodePath("")':
        return "null", f'{name} ?? new NodePath("")'
    if kind == "PackedByteArray" and given == "PackedByteArray()":
        return "null", f"{name} ?? new {made[:-2]}[0]"
    return sys.exit(f"make_csharp.py knows no default {given} of {kind} in {inside}: add it")


class ClassMaker:
    def __init__(self, types, name, root):
        self.types, self.name, self.root = types, name, root
        self.is_singleton = name in SINGLETONS
        self.base = engine_base(types.classes, root)
        self.parent = root.get("inherits") if root.get("inherits") in types.classes else None
        self.holder = "Instance" if self.is_singleton else holder_of(types.classes, root)
        self.static = "static " if self.is_singleton else ""

    def head(self, uses_system=False):
        uses = "using System;\n" if uses_system else ""
        return (f"// <auto-generated/>\n// SPDX-License-Identifier: MIT\n// Made by scripts/lib/make_csharp.py from doc_classes/{self.name}.xml.\n"
                f"{uses}using Godot;\n\nnamespace SoftBodies\n{{\n")

    def names(self):
        """Names that are handed to the engine, each made once."""
        members = sorted({e.get("name") for tag in ("member", "method") for e in self.root.iter(tag)})
        lines = [f'\t\t\tinternal static readonly StringName {pascal(name)} = "{name}";' for name in members]
        return "\t\tprivate static class Names\n\t\t{\n" + "\n".join(lines) + "\n\t\t}\n"

    def basics(self):
        name, base, holder = self.name, self.base, self.holder
        summary = summary_of(self.root)
        if self.is_singleton:
            return (f"\t/// <summary>{summary}</summary>\n\tpublic static partial class {name}\n\t{{\n"
                    f"\t\tprivate static GodotObject _instance;\n\n"
                    f"\t\t/// <summary>The engine's singleton.</summary>\n"
                    f'\t\tpublic static GodotObject Instance => _instance ?? (_instance = Native.Singleton("{name}"));\n\n' + self.names() + "\t}\n")
        return (f"\t/// <summary>{summary} Stands for the engine's object, which is <see cref=\"{holder}\"/>.</summary>\n"
                f"\tpublic sealed partial class {name}\n\t{{\n"
                f"\t\t/// <summary>The engine's object, as the nearest class that C# knows.</summary>\n"
                f"\t\tpublic {base} {holder} {{ get; }}\n\n"
                f"\t\t/// <summary>Makes a new {name}. Throws if the addon's library is not loaded.</summary>\n"
                f'\t\tpublic {name}() : this(({base})Native.New("{name}")) {{ }}\n\n'
                f"\t\tprivate {name}({base} instance) {{ {holder} = instance; }}\n\n"
                f"\t\t/// <summary>The typed face of a {name}; null for null. Throws for an object of another class.</summary>\n"
                f"\t\tpublic static {name} From(GodotObject instance) =>\n"
                f'\t\t\tinstance == null ? null : new {name}(Native.Checked<{base}>(instance, "{name}"));\n\n'
                f"\t\t/// <summary>Whether an object is a {name}.</summary>\n"
                f'\t\tpublic static bool Is(GodotObject instance) => instance != null && instance.IsClass("{name}");\n\n'
                + self.parent_view() +
                f"\t\tpublic static implicit operator {base}({name} value) => value == null ? null : value.{holder};\n\n"
                f"\t\tpublic static bool operator ==({name} a, {name} b) => Equals(a, b);\n\n"
                f"\t\tpublic static bool operator !=({name} a, {name} b) => !Equals(a, b);\n\n"
                f"\t\tpublic override bool Equals(object other) => other is {name} same && same.{holder} == {holder};\n\n"
                f"\t\tpublic override int GetHashCode() => {holder}.GetHashCode();\n\n" + self.names() + "\t}\n")

    def parent_view(self):
        """The members of the class that it descends from, if that is one of ours."""
        if self.parent is None:
            return ""
        return (f"\t\t/// <summary>The same object, with the members of a {self.parent}.</summary>\n"
                f"\t\tpublic {self.parent} As{self.parent} => {self.parent}.From({self.holder});\n\n")

    def enums(self):
        groups = {}
        for constant in self.root.iter("constant"):
            groups.setdefault(constant.get("enum"), []).append(constant)
        parts = []
        for enum, constants in groups.items():
            prefix = re.sub(r"(?<!^)(?=[A-Z])", "_", enum).upper() + "_"
            if not all(c.get("name").startswith(prefix) for c in constants):
                prefix = constants[0].get("name").rsplit("_", 1)[0] + "_"
            lines = [f"\t\t\t/// <summary>{summary_of(c)}</summary>\n\t\t\t{pascal(c.get('name').removeprefix(prefix))} = {c.get('value')}," for c in constants]
            parts.append(f"\t\tpublic enum {self.types.enum_name(self.name, enum)}\n\t\t{{\n" + "\n".join(lines) + "\n\t\t}\n")
        return parts

    def properties(self):
        parts = []
        for member in self.root.iter("member"):
            name, kind, enum = member.get("name"), member.get("type"), member.get("enum")
            made, reads = self.types.of(self.name, kind, enum, name)
            get = f"get => {reads.format(f'{self.holder}.Get(Names.{pascal(name)})')};"
            value = self.types.to_variant(kind, enum, "value")
            body = f"\t\t\t{get}\n"
            if member.get("setter"):
                body += f"\t\t\tset => {self.holder}.Set(Names.{pascal(name)}, {value});\n"
            parts.append(f"\t\t/// <summary>{summary_of(member)}</summary>\n\t\tpublic {self.static}{made} {pascal(name)}\n\t\t{{\n{body}\t\t}}\n")
        return parts

    def methods(self):
        parts = []
        for method in self.root.iter("method"):
            name, back = method.get("name"), method.find("return")
            taken, passed = [], []
            for param in method.iter("param"):
                made = self.types.of(self.name, param.get("type"), param.get("enum"), param.get("name"))[0]
                default, value = default_of(self.types, self.name, param)
                if default == "null" and made == "Vector2":
                    made += "?"
                taken.append(f"{made} {camel(param.get('name'))}" + (f" = {default}" if default is not None else ""))
                passed.append(value)
            is_static = "static" in (method.get("qualifiers") or "")
            if is_static:
                call = f"Native.CallStatic({', '.join([f'{chr(34)}{self.name}{chr(34)}', f'Names.{pascal(name)}'] + passed)})"
            else:
                call = f"{self.holder}.Call({', '.join([f'Names.{pascal(name)}'] + passed)})"
            made = "void"
            if back is not None and back.get("type") != "void":
                made, reads = self.types.of(self.name, back.get("type"), back.get("enum"), name)
                call = reads.format(call)
            keyword = "static " if is_static else self.static
            parts.append(f"\t\t/// <summary>{summary_of(method)}</summary>\n"
                         f"\t\tpublic {keyword}{made} {pascal(name)}({', '.join(taken)}) =>\n\t\t\t{call};\n")
        return parts

    def signals(self):
        signals = list(self.root.iter("signal"))
        if not signals:
            return []
        lines = [f'\t\t\tpublic static readonly StringName {pascal(s.get("name"))} = "{s.get("name")}";' for s in signals]
        parts = ["\t\t/// <summary>Names of signals, for <c>ToSignal</c>.</summary>\n\t\tpublic static class SignalName\n\t\t{\n" + "\n".join(lines) + "\n\t\t}\n"]
        for signal in signals:
            kinds = []
            for param in signal.iter("param"):
                if param.get("type").endswith("[]"):
                    kinds.append("Godot.Collections.Array")  # The engine converts no other array for a callable.
                else:
                    kinds.append(self.types.of(self.name, param.get("type"), param.get("enum"), param.get("name"))[0])
            action = f"Action<{', '.join(kinds)}>" if kinds else "Action"
            name = pascal(signal.get("name"))
            parts.append(f"\t\t/// <summary>{summary_of(signal)}</summary>\n\t\tpublic event {action} {name}\n\t\t{{\n"
                         f"\t\t\tadd => {self.holder}.Connect(SignalName.{name}, Callable.From(value));\n"
                         f"\t\t\tremove => {self.holder}.Disconnect(SignalName.{name}, Callable.From(value));\n\t\t}}\n")
        return parts

    def partial(self, parts, uses_system=False):
        kind = "static partial class" if self.is_singleton else "sealed partial class"
        return self.head(uses_system) + f"\tpublic {kind} {self.name}\n\t{{\n" + "\n".join(parts) + "\t}\n}\n"

    def files(self):
        """The text of each file by its name."""
        made = {f"{self.name}.g.cs": self.head() + self.basics() + "}\n"}
        for name, parts in (("Enums", self.enums()), ("Properties", self.properties()), ("Methods", self.methods()), ("Signals", self.signals())):
            half = (len(parts) + 1) // 2
            if sum(part.count("\n") + 1 for part in parts) > 480:
                made[f"{self.name}.{name}A.g.cs"] = self.partial(parts[:half])
                made[f"{self.name}.{name}B.g.cs"] = self.partial(parts[half:])
            elif parts:
                made[f"{self.name}.{name}.g.cs"] = self.partial(parts, name == "Signals")
        return made


def make(repository):
    classes = {}
    for path in sorted((repository / "doc_classes").glob("*.xml")):
        root = ElementTree.parse(path).getroot()
        if root.get("name") not in LEFT_OUT:
            classes[root.get("name")] = root
    types = Types({name: root for name, root in classes.items() if name not in SINGLETONS})
    types.members |= {name: set() for name in SINGLETONS}
    files = {}
    for name, root in classes.items():
        files |= ClassMaker(types, name, root).files()
    return files


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("repository", type=Path)
    options = parser.parse_args()
    files = make(options.repository)
    folder = options.repository / TARGET
    there = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.g.cs")}
    if options.check:
        stale = sorted(name for name in files.keys() | there.keys() if files.get(name) != there.get(name))
        if stale:
            sys.exit(f"{TARGET} is older than doc_classes: {', '.join(stale)}. Run: python3 scripts/lib/make_csharp.py .")
        return
    folder.mkdir(parents=True, exist_ok=True)
    for name in there.keys() - files.keys():
        (folder / name).unlink()
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
