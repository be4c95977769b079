# SPDX-License-Identifier: MIT
"""The checker of packages takes a good one, and refuses it broken in each way that has a name."""

import shutil
import tempfile
import unittest
import zipfile
from pathlib import Path
from unittest import mock

import fake_repository
from addon_files import ADDON, EXTENSION, LIBRARIES, keys_of, library_name
from fake_repository import elf, mach, pe, png, universal

import check_package
import pack_addon

LINUX = LIBRARIES / library_name("linux.debug.x86_64")
WINDOWS = LIBRARIES / library_name("windows.release.x86_64")
MACOS = LIBRARIES / library_name("macos.release")
WEB = LIBRARIES / library_name("web.release.wasm32")


class PackageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        fake_repository.write(cls.folder / "repository")
        cls.good, absent = pack_addon.pack(cls.folder / "repository", cls.folder)
        assert cls.good.name == "soft_body_2d-0.1.0.zip" and not absent

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def faults(self, changes=None, name="soft_body_2d-0.1.0.zip", partial=False):
        """The faults of the good package with some of its files replaced, added, or (None) left out."""
        with zipfile.ZipFile(self.good) as archive:
            files = {info.filename: archive.read(info) for info in archive.infolist()}
        files |= {str(place): content for place, content in (changes or {}).items()}
        broken = self.folder / "broken" / name
        broken.parent.mkdir(exist_ok=True)
        with zipfile.ZipFile(broken, "w") as archive:
            for place, content in files.items():
                if content is not None:
                    archive.writestr(place, content)
        return check_package.check(broken, partial)

    def assert_one_fault(self, words, *arguments, **options):
        found = self.faults(*arguments, **options)
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def extension(self, old, new):
        with zipfile.ZipFile(self.good) as archive:
            text = archive.read(str(EXTENSION)).decode()
        self.assertIn(old, text)
        return {EXTENSION: text.replace(old, new).encode()}

    def test_a_good_package_has_no_fault(self):
        self.assertEqual(check_package.check(self.good), [])
        self.assertEqual(self.faults(), [])

    def test_the_same_files_make_the_same_bytes(self):
        again, _ = pack_addon.pack(self.folder / "repository", self.folder / "again")
        self.assertEqual(again.read_bytes(), self.good.read_bytes())

    def test_a_library_that_is_listed_must_be_packed(self):
        for key in keys_of():
            self.assert_one_fault(f"lists {library_name(key)}, which is not in the package", {LIBRARIES / library_name(key): None})

    def test_a_library_that_is_packed_must_be_listed(self):
        self.assert_one_fault("is not listed", {LIBRARIES / "libsoft_body_2d.ios.template_debug.universal.dylib": universal()})
        self.assert_one_fault("is not listed", {LIBRARIES / "libsoft_body_2d.windows.template_debug.x86_64.pdb": b"symbols"})

    def test_a_release_has_every_platform(self):
        lines = [f'{key} = "res://{LIBRARIES / library_name(key)}"\n' for key in keys_of(["linux.arm64"])]
        changes = self.extension("".join(lines), "") | {LIBRARIES / library_name(key): None for key in keys_of(["linux.arm64"])}
        self.assert_one_fault("does not list linux.debug.arm64, linux.release.arm64", changes)
        self.assertEqual(self.faults(changes, partial=True), [])

    def test_debug_and_release_come_together(self):
        line = f'linux.debug.arm64 = "res://{LIBRARIES / library_name("linux.debug.arm64")}"\n'
        changes = self.extension(line, "") | {LIBRARIES / library_name("linux.debug.arm64"): None}
        self.assert_one_fault("lists linux.release.arm64 and not linux.debug.arm64", changes, partial=True)

    def test_a_platform_of_no_release_is_not_listed(self):
        new = 'ios.debug = "res://a"\nios.release = "res://b"\nmacos.debug ='
        self.assertEqual(len(self.faults(self.extension("macos.debug =", new))), 2)

    def test_names_are_those_of_the_build(self):
        changes = self.extension("template_debug.arm64.so", "template_debug.aarch64.so")
        self.assertTrue(any("the build calls it" in fault for fault in self.faults(changes)))
        swapped = self.extension("linux.template_debug.x86_64", "linux.template_release.x86_64")
        self.assertTrue(any("linux.debug.x86_64 is" in fault for fault in self.faults(swapped)))

    def test_a_key_stands_once(self):
        line = f'macos.debug = "res://{LIBRARIES / library_name("macos.debug")}"\n'
        self.assert_one_fault("lists macos.debug twice", self.extension(line, line + line))

    def test_a_library_is_what_its_name_says(self):
        self.assert_one_fault("is not for x86_64: its machine is 183", {LINUX: elf(183)})
        self.assert_one_fault("is no 64-bit library", {LINUX: b"version https://git-lfs"})
        self.assert_one_fault("is no shared library", {LINUX: elf(62)[:16] + b"\2" + elf(62)[17:]})
        self.assert_one_fault("is not for x86_64: its machine is 0x14c", {WINDOWS: pe(0x14C)})
        self.assert_one_fault("is no DLL", {WINDOWS: pe(0x8664, 0)})
        self.assert_one_fault("is no library of Windows", {WINDOWS: elf(62)})
        self.assert_one_fault("is no WebAssembly", {WEB: b"\0asm\2\0\0\0soft_body_2d_library_init"})

    def test_macos_wants_both_processors_each_signed(self):
        self.assert_one_fault("is not signed for arm64", {MACOS: universal(signed=("x86_64",))})
        self.assert_one_fault("is not signed for x86_64", {MACOS: universal(signed=("arm64",))})
        self.assert_one_fault("has no code for x86_64", {MACOS: universal(cpus=("arm64",))})
        self.assert_one_fault("is no universal library", {MACOS: mach(0x0100000C)})

    def test_a_library_has_the_entry(self):
        self.assert_one_fault("has no function soft_body_2d_library_init", {LINUX: elf(62)[:64]})
        self.assert_one_fault("entry_symbol", self.extension("soft_body_2d_library_init", "other_init"))

    def test_the_lowest_godot_is_named(self):
        self.assert_one_fault("compatibility_minimum", self.extension('compatibility_minimum = "4.3"\n', ""))

    def test_what_users_need_is_there(self):
        for name in ("LICENSE", "README.md", "CHANGELOG.md", "icon.png"):
            self.assert_one_fault(f"{name} is missing or empty", {ADDON / name: None})
            self.assert_one_fault(f"{name} is missing or empty", {ADDON / name: b""})
        for name in ("plugin.cfg", "soft_body_2d.gdextension", "soft_body_2d_plugin.gd"):
            self.assertTrue(any(f"{name} is missing" in fault for fault in self.faults({ADDON / name: None})))

    def test_a_license_is_one(self):
        self.assert_one_fault("is no license", {ADDON / "LICENSE": b"MIT"})

    def test_the_icon_is_a_square_picture(self):
        self.assert_one_fault("is no PNG", {ADDON / "icon.png": b"<svg/>"})
        self.assert_one_fault("64 by 64 pixels", {ADDON / "icon.png": png(64, 64)})
        self.assert_one_fault("256 by 128 pixels", {ADDON / "icon.png": png(256, 128)})

    def test_icons_of_classes_are_there(self):
        self.assert_one_fault("the icon of SoftBody2D", {ADDON / "icons" / "soft_body_2d.svg": None})

    def test_sources_stay_out(self):
        for name in ("src/core/vec2.h", "src/node.cpp", "SConstruct", "bin.o", "tests/run.py", "doc_classes/SoftBody2D.xml", ".git/config", "a.blend"):
            self.assert_one_fault("is nothing that users install", {ADDON / name: b"x"})

    def test_everything_lies_in_the_addons_folder(self):
        for name in ("README.md", "addons/other/plugin.cfg", "/etc/passwd.md", f"{ADDON}/../../project.md"):
            self.assert_one_fault("lies outside of", {name: b"x" * 600})

    def test_names_differ_on_every_system(self):
        self.assert_one_fault("are one file on Windows", {ADDON / "Readme.md": b"x"})

    def test_a_link_is_refused(self):
        info = zipfile.ZipInfo(str(ADDON / "link.md"))
        info.external_attr = 0o120777 << 16
        linked = self.folder / "broken" / "soft_body_2d-0.1.0.zip"
        linked.parent.mkdir(exist_ok=True)
        shutil.copy(self.good, linked)
        with zipfile.ZipFile(linked, "a") as archive:
            archive.writestr(info, "README.md")
        self.assertIn("is a link", check_package.check(linked)[0])

    def test_it_is_called_by_its_version(self):
        self.assert_one_fault("holds version 0.1.0", name="soft_body_2d-0.2.0.zip")
        self.assert_one_fault("names no version", {ADDON / "plugin.cfg": b'[plugin]\nscript="soft_body_2d_plugin.gd"\n'})

    def test_the_plugins_script_is_there(self):
        self.assert_one_fault("names the script other.gd", {ADDON / "plugin.cfg": b'version="0.1.0"\nscript="other.gd"\n'})

    def test_it_is_not_too_large(self):
        with mock.patch.object(check_package, "LARGEST_PACKAGE", self.good.stat().st_size - 1):
            self.assertIn("MB", check_package.check(self.good)[0])
        with mock.patch.object(check_package, "LARGEST_PACKAGE", self.good.stat().st_size):
            self.assertEqual(check_package.check(self.good), [])

    def test_a_damaged_archive_is_refused(self):
        damaged = self.folder / "broken" / "soft_body_2d-0.1.0.zip"
        damaged.parent.mkdir(exist_ok=True)
        content = bytearray(self.good.read_bytes())
        with zipfile.ZipFile(self.good) as archive:
            info = archive.getinfo(str(ADDON / "icon.png"))
        content[info.header_offset + 30 + len(info.filename) + info.compress_size // 2] ^= 0xFF
        damaged.write_bytes(content)
        with self.subTest("a file"):
            self.assertTrue(check_package.check(damaged))
        damaged.write_bytes(content[:1000])
        self.assertEqual(check_package.check(damaged), [f"{damaged.name} is no zip archive"])


class PackingTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.repository = self.folder / "repository"
        fake_repository.write(self.repository)
        self.packages = self.folder / "packages"

    def pack(self, partial):
        self.package, absent = pack_addon.pack(self.repository, self.packages, partial)
        return absent

    def test_a_library_that_was_not_built_stops_a_release(self):
        (self.repository / LINUX).unlink()
        with self.assertRaisesRegex(SystemExit, LINUX.name):
            self.pack(False)
        self.assertFalse(self.packages.exists())

    def test_a_partial_package_lists_what_it_holds(self):
        for key in keys_of():
            if not key.startswith("linux."):
                (self.repository / LIBRARIES / library_name(key)).unlink()
        self.assertEqual(len(self.pack(True)), len(keys_of()) - 4)
        self.assertEqual(self.package.name, "soft_body_2d-0.1.0-partial.zip")
        self.assertEqual(check_package.check(self.package, partial=True), [])
        self.assertIn("does not list windows", check_package.check(self.package)[0])

    def test_a_platform_of_one_library_is_left_out_of_a_partial_package(self):
        (self.repository / LINUX).unlink()
        self.assertEqual(set(self.pack(True)), {library_name(key) for key in keys_of(["linux.x86_64"])})
        self.assertEqual(check_package.check(self.package, partial=True), [])

    def test_no_library_at_all_is_no_package(self):
        shutil.rmtree(self.repository / LIBRARIES)
        with self.assertRaisesRegex(SystemExit, "no platform"):
            self.pack(True)

    def test_what_a_build_leaves_beside_libraries_is_not_packed(self):
        (self.repository / LIBRARIES / "libsoft_body_2d.windows.template_debug.x86_64.lib").write_bytes(b"x")
        self.pack(False)
        with zipfile.ZipFile(self.package) as archive:
            self.assertFalse([name for name in archive.namelist() if name.endswith(".lib")])

    def test_the_manual_comes_with_its_pictures_and_no_scripts(self):
        self.pack(False)
        with zipfile.ZipFile(self.package) as archive:
            names = archive.namelist()
        self.assertIn(str(ADDON / "docs" / "pictures" / "body.png"), names)
        self.assertFalse([name for name in names if name.endswith(".py")])


if __name__ == "__main__":
    unittest.main()
