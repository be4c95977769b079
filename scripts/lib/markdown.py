# SPDX-License-Identifier: MIT
"""What our pages link."""

import re

_LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")


def linked_files(text):
    """Relative files that a Markdown text links or shows."""
    return [link for link in _LINK.findall(text) if "://" not in link and not link.startswith("mailto:")]
