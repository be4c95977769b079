# SPDX-License-Identifier: MIT
"""The checker of versions takes places that agree, and tells each one that does not."""

import shutil
import tempfile
import unittest
from pathlib import Path

import fake_repository
from addon_files import ADDON, EXTENSION

import check_versions

RELEASED = "## [1.2.3] - 2026-11-25\n\n- A change.\n\n## [1.2.2] - 2026-10-01\n\n- Another.\n"


class VersionsTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        fake_repository.write(self.folder, "1.2.3", RELEASED)

    def replace(self, name, old, new):
        text = (self.folder / name).read_text()
        self.assertIn(old, text)
        (self.folder / name).write_text(text.replace(old, new))

    def assert_one_fault(self, words, tag=None):
        found = check_versions.check(self.folder, tag)
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def changelog(self, text):
        (self.folder / "CHANGELOG.md").write_text("# Changelog\n\n" + text)

    def test_places_that_agree_have_no_fault(self):
        self.assertEqual(check_versions.check(self.folder), [])
        self.assertEqual(check_versions.check(self.folder, "v1.2.3"), [])

    def test_this_repository_agrees(self):
        self.assertEqual(check_versions.check(fake_repository.ROOT, check_versions.tag_of(fake_repository.ROOT)), [])

    def test_a_tag_is_the_version(self):
        self.assert_one_fault("call it v1.2.3", "v1.2.4")
        self.assert_one_fault("call it v1.2.3", "1.2.3")

    def test_the_changelogs_newest_release_is_the_version(self):
        self.replace(ADDON / "plugin.cfg", "1.2.3", "1.3.0")
        self.replace("README.md", "1.2.3", "1.3.0")
        self.assert_one_fault("the newest release is 1.2.3, and plugin.cfg has 1.3.0")

    def test_before_the_first_release_there_is_none(self):
        self.changelog("## [Unreleased]\n\n- A change.\n")
        self.assertEqual(check_versions.check(self.folder), [])
        self.assert_one_fault("has no release, and the tag is v1.2.3", "v1.2.3")

    def test_what_is_unreleased_stops_a_tag(self):
        self.changelog("## [Unreleased]\n\n- A change.\n\n" + RELEASED)
        self.assertEqual(check_versions.check(self.folder), [])
        self.assert_one_fault("changes that are unreleased", "v1.2.3")
        self.changelog("## [Unreleased]\n\n" + RELEASED)
        self.assertEqual(check_versions.check(self.folder, "v1.2.3"), [])

    def test_headings_are_well_formed(self):
        self.changelog(RELEASED.replace("[1.2.2] - 2026-10-01", "1.2.2"))
        self.assert_one_fault("the heading '1.2.2'")
        self.changelog(RELEASED.replace("2026-10-01", "2026-02-30"))
        self.assert_one_fault("2026-02-30 is no day")
        self.changelog(RELEASED + "\n## [Unreleased]\n")
        self.assert_one_fault("the heading '[Unreleased]'")
        self.changelog("")
        self.assert_one_fault("no heading")

    def test_releases_are_in_order(self):
        self.changelog(RELEASED + "\n## [1.10.0] - 2026-01-01\n")
        self.assert_one_fault("not in order")
        self.changelog(RELEASED + "\n## [1.2.2] - 2026-01-01\n")
        self.assert_one_fault("stands twice")
        self.changelog("## [1.2.3] - 2026-11-25\n\n## [1.2.3-rc.1] - 2026-11-01\n")
        self.assertEqual(check_versions.check(self.folder), [])

    def test_the_version_is_one(self):
        for version in ("1.2", "1.2.3.4", "v1.2.3", "01.2.3", ""):
            fake_repository.write(self.folder, version, RELEASED)
            found = check_versions.check(self.folder)
            self.assertTrue(any("is no version such as 1.2.3" in fault for fault in found), (version, found))

    def test_pages_name_the_package_of_this_version(self):
        (self.folder / "docs" / "manual.md").write_text("Unpack soft_body_2d-1.2.2.zip.\n")
        self.assert_one_fault("docs/manual.md names the package of 1.2.2")

    def test_the_lowest_godot_is_one(self):
        self.replace("README.md", "4.3", "4.2")
        self.assert_one_fault("README.md says Godot 4.2 and later")
        self.replace("README.md", "Godot 4.2 and later", "Godot")
        self.assert_one_fault("does not say")
        self.replace("README.md", "For Godot:", "For Godot 4.3 and later:")
        self.replace("SConstruct", "4.3", "4.4")
        self.assert_one_fault("SConstruct builds for 4.4")
        self.replace("SConstruct", "4.4", "4.3")
        self.replace(EXTENSION, '"4.3"', '"4.1"')
        self.assertEqual(len(check_versions.check(self.folder)), 3)


if __name__ == "__main__":
    unittest.main()
