"""Exact geometry that the checks of the command share: tests/cli/exact_plane.py, anchor.py, rows_rule.py and
side_anchor.py, from here."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
import ease_bounds  # noqa: E402,F401
import exact_plane as plane  # noqa: E402,F401
from anchor import anchor  # noqa: E402,F401
import rows_oracle  # noqa: E402,F401
import rows_rule  # noqa: E402,F401
from side_anchor import side_anchor  # noqa: E402,F401
