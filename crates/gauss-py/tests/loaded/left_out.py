"""Tests of compiled classes that models at run time fail, each with the reason. One that passes is an error here."""

import pytest

CONTACTS = "forces of contacts are those of compiled kernels"
LEFT_OUT = {
    "test_contacts.py::test_forces_at_a_state": CONTACTS,
    "test_contacts.py::test_from_event_to_event": CONTACTS,
    "test_contacts.py::test_states_between_and_events_of_ones_own": CONTACTS,
    "test_contacts.py::test_in_steps": CONTACTS,
    "test_contacts.py::test_inputs_of_contact_runs": CONTACTS,
    "test_contacts.py::test_controllers_in_steps_of_contacts": CONTACTS,
    "test_contacts.py::test_ranges_and_dry_friction": CONTACTS,
    "test_contacts.py::test_failures_of_contact_runs_keep_what_there_is": CONTACTS,
    "test_contacts.py::test_ensembles_with_contacts": CONTACTS,
    "test_contacts.py::test_the_study_of_pucks_stops_where_the_formula_says": CONTACTS,
    "test_methods.py::test_methods_agree": "power series and Rosenbrock's method are of compiled kernels",
    "test_methods.py::test_mistakes_with_methods": "a method that is missing is told in other words",
    "test_processes.py::test_exceptions_are_those_of_one_module": "classes are not in the module that raises",
    "test_runs.py::test_states_of_elements_and_tables": "tables are values of Rust",
    "test_stubs.py::test_the_stubs_in_the_package_are_those_of_the_module": "stubs are those of the package `gauss`",
    "test_stubs.py::test_type_checkers_read_them": "classes are known at run time",
    "test_stubs.py::test_type_checkers_find_mistakes": "classes are known at run time",
}
#: What is refused at once is over before it is interrupted.
NOT_RUN = {"test_contacts.py::test_contact_runs_are_interrupted": CONTACTS}


def pytest_collection_modifyitems(items):
    for item in items:
        name = item.nodeid.split("/")[-1]
        if name in LEFT_OUT:
            item.add_marker(pytest.mark.xfail(strict=True, reason=LEFT_OUT[name]))
        if name in NOT_RUN:
            item.add_marker(pytest.mark.skip(reason=NOT_RUN[name]))
