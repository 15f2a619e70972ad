"""Exceptions: they pickle by their arguments, and have all mistakes at once."""

from typing import NamedTuple


class Mistake(NamedTuple):
    """A mistake of a scene: line and column count from one, in the text of `SceneError.source`."""

    line: int
    column: int
    message: str


class Violation(NamedTuple):
    """A parameter that no body has: the number that breaks a rule, the rule by its name, and both in words."""

    field: str
    value: float
    rule: str
    message: str


class SceneError(ValueError):
    """A scene that is none: `mistakes` has all of them, `source` the text that they are in."""

    def __init__(self, mistakes, source):
        self.mistakes = [Mistake(*mistake) for mistake in mistakes]
        self.source = source
        super().__init__([tuple(mistake) for mistake in self.mistakes], source)

    def __str__(self):
        lines, told = self.source.splitlines(), []
        for line, column, message in self.mistakes:
            told.append(f"{line}:{column}: {message}")
            if line <= len(lines):
                told += ["    " + lines[line - 1], "    " + " " * (column - 1) + "^"]
        return "\n".join(told)


class ParameterError(ValueError):
    """Parameters that no body has: `violations` has all of them, `fields` a pair (name, what is wrong) for each."""

    def __init__(self, violations, message):
        self.violations = [Violation(*violation) for violation in violations]
        self.fields = [(violation.field, violation.message) for violation in self.violations]
        self.message = message
        super().__init__([tuple(violation) for violation in self.violations], message)

    def __str__(self):
        return self.message


class ContactError(TypeError):
    """An answer that has no forces of contacts, of a scene that has some: see `Kernel.without_contacts`."""
