"""Tests of compiled classes that models at run time fail, each with the reason. One that passes is an error here."""

import pytest

LEFT_OUT = {
    "test_methods.py::test_methods_agree": "power series are of compiled kernels",
    "test_methods.py::test_mistakes_with_methods": "a method that is missing is told in other words",
    "test_processes.py::test_exceptions_are_those_of_one_module": "classes are not in the module that raises",
    "test_stubs.py::test_the_stubs_in_the_package_are_those_of_the_module": "stubs are those of the package `gauss`",
    "test_stubs.py::test_type_checkers_read_them": "classes are known at run time",
    "test_stubs.py::test_type_checkers_find_mistakes": "classes are known at run time",
}


def pytest_collection_modifyitems(items):
    for item in items:
        name = item.nodeid.split("/")[-1]
        if name in LEFT_OUT:
            item.add_marker(pytest.mark.xfail(strict=True, reason=LEFT_OUT[name]))
