"""Mistakes of scenes: they pickle by their arguments, and come all at once."""

from typing import NamedTuple


class Mistake(NamedTuple):
    """A mistake of a scene: line and column count from one, in the text of `SceneError.source`."""

    line: int
    column: int
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
