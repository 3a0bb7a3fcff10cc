# SPDX-License-Identifier: GPL-3.0-or-later
"""What values each option may have: for presets and the command line, whose values come from outside."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class OptionKind:
    """One option of the operator. The type of its default is its own."""

    name: str
    default: object
    description: str = ""
    choices: tuple = ()  # of an enumeration
    low: float = -math.inf
    high: float = math.inf

    def checked(self, value):
        """The value as the option holds it; ValueError says in words what is wrong with it."""
        if self.choices:
            if value not in self.choices:
                raise ValueError(f"{self.name} is one of {', '.join(self.choices)}, not {value!r}")
            return value
        if isinstance(self.default, float) and type(value) is int:
            value = float(value)
        if type(value) is not type(self.default):
            raise ValueError(f"{self.name} is {_WORDS[type(self.default)]}, not {value!r}")
        if isinstance(value, int | float) and not self.low <= value <= self.high:  # not a number fails too
            raise ValueError(f"{self.name} is from {self.low:g} to {self.high:g}, not {value!r}")
        return value

    def parsed(self, text):
        """From a command line, where an enumeration's values are written small."""
        if self.choices:
            return self.checked(text.upper())
        if isinstance(self.default, str):
            return text
        try:
            value = type(self.default)(text)
        except ValueError:
            raise ValueError(f"{self.name} is {_WORDS[type(self.default)]}, not {text!r}") from None
        return self.checked(value)


_WORDS = {bool: "True or False", int: "a whole number", float: "a number", str: "a text"}
