"""The exceptions of all packages that Gauss makes: the package that is imported first brings this module."""

from importlib import import_module


class _Raised:
    """Pickles by the package that raised it: this module is in no file, and comes with any package."""

    package = None

    def __reduce__(self):
        if self.package is None:
            return super().__reduce__()
        return import_module(self.package)._raised, (type(self).__name__, self.args, self.__dict__)


class ParameterError(_Raised, ValueError):
    """Parameters that cannot be: `fields` has a pair (name, what is wrong) for each mistake, `violations` of each number
    that breaks a rule the field, the number, the rule by its name, and all of it in words."""

    fields = []
    violations = []


class IntegrationError(_Raised, RuntimeError):
    """A run that did not reach its end: `run` has the states up to the last good one."""

    run = None


class ContactError(_Raised, TypeError):
    """An answer that has no forces of contacts, of a scene with `contacts`, whose names these are."""

    contacts = []
