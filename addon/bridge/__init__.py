# SPDX-License-Identifier: GPL-3.0-or-later
"""The only place that touches mesh data (mesh.py, divide.py, cuts.py) and that knows Blender's versions apart (versions.py)."""
