//! Rows of what the equations of a scene may hold: smooth forces, constraints, states, modes, tables.

use super::cells::{Row, moot, refused, shown, together};

const NO_CONTACTS: &str =
    "a scene without contacts has no event or impulse of contact: a compile error, no `ContactSystem`";
const TABLES_HAVE_NO_SERIES: &str = "from cell to cell a table is another polynomial, so that no series holds over a \
                                     step: a compile error at `taylor`, which calls it `a function of your own`";

const REDUNDANT_HAS_NO_SERIES: &str = "rows are kept or let go by the size of their pivots, which has no power series \
                                       where it passes through zero: a message at `taylor`";

pub const SMOOTH: Row = Row {
    name: "Smooth forces",
    clause: "bodies, springs, dampers, potentials, media",
    cells: &[
        ("fix", shown("tests/tests/runs/integrators.rs", "orders_on_a_heavy_top_against_its_reference")),
        ("ada", shown("gauss-runtime/src/integrate/tests.rs", "adaptive_steps_keep_the_tolerance_and_save_work")),
        ("tay", shown("tests/tests/runs/taylor/runs.rs", "tops_reach_their_references_at_every_tolerance")),
        ("ros", shown("tests/tests/stiff/main.rs", "what_decays_fast_is_gone_after_a_step")),
        ("imp", shown("tests/long_runs/tests/energy_momentum.rs", "orders_against_a_reference")),
        ("evt", refused(NO_CONTACTS)),
        ("stp", refused(NO_CONTACTS)),
        (
            "one",
            shown(
                "gauss-runtime/src/integrate/drive/runs/stepper_tests.rs",
                "steps_have_the_bits_of_the_run_whatever_is_asked_between_them",
            ),
        ),
        ("lan", shown("tests/tests/runs/batch/mod.rs", "every_state_gets_the_bits_of_a_run_of_its_own")),
        ("thr", shown("tests/tests/runs/batch/ensembles.rs", "every_run_takes_the_steps_that_it_would_take_alone")),
        ("at", shown("tests/tests/runs/between.rs", "states_between_samples_have_their_error")),
        ("tab", shown("crates/gauss-tables/tests/files.rs", "csv_reads_back")),
        ("plt", shown("crates/gauss-tables/tests/files.rs", "a_panel_for_each_unit")),
        (
            "pag",
            shown(
                "crates/gauss-playback/tests/playback/page.rs",
                "poses_are_those_of_the_kernel_and_nothing_comes_from_elsewhere",
            ),
        ),
        ("mon", shown("examples/thrown_robot/tests.rs", "a_thrown_robot_keeps_its_spin")),
        (
            "fwd",
            shown("crates/gauss-sensitivity/tests/derivatives/groups.rs", "poses_have_increments_of_six_components"),
        ),
        (
            "adj",
            shown(
                "crates/gauss-sensitivity/tests/derivatives/ensembles.rs",
                "the_gradient_of_an_ensemble_is_the_sum_of_gradients",
            ),
        ),
        ("lin", shown("tests/tests/derivatives/linearize.rs", "a_body_in_a_fluid")),
        ("dst", shown("tests/tests/derivatives/discrete.rs", "groups_and_scalars")),
        ("run", shown("tests/tests/derivatives/discrete.rs", "steps_after_one_another")),
        ("stu", shown("crates/gauss-study/tests/study/lanes.rs", "rows_of_lanes_are_those_of_single_runs")),
        ("py", shown("examples/python/tests/test_methods.py", "test_methods_agree")),
    ],
};

pub const MASS: Row = Row {
    name: "Mass that varies",
    clause: "`mass = m - burn * t`, `mass_flow(…)`",
    cells: &[
        ("fix", together("mass::steps")),
        ("ada", shown("tests/tests/mass_that_varies/main.rs", "a_rocket_reaches_the_velocity_of_tsiolkovsky")),
        ("tay", together("mass::series")),
        ("ros", together("mass::stiff")),
        ("imp", together("mass::implicit")),
        ("evt", shown("tests/tests/goes_together/contacts.rs", "mass")),
        ("stp", shown("tests/tests/goes_together/contacts.rs", "mass")),
        ("one", together("mass::by_hand")),
        ("lan", together("mass::lanes_and_threads")),
        ("thr", together("mass::lanes_and_threads")),
        ("at", together("mass::between")),
        ("tab", together("mass::table_and_plot")),
        ("plt", together("mass::table_and_plot")),
        ("pag", together("mass::page")),
        ("mon", together("mass::energy")),
        ("fwd", together("mass::of_runs")),
        ("adj", together("mass::of_runs")),
        ("lin", shown("tests/tests/mass_that_varies/main.rs", "derivatives_know_that_mass_varies")),
        ("dst", together("mass::of_a_step")),
        ("run", together("mass::along_a_run")),
        ("stu", together("mass::study")),
        ("py", shown("crates/gauss-py/tests/test_runs.py", "test_rockets_burn_their_fuel")),
    ],
};

pub const CONSTRAINTS: Row = Row {
    name: "Constraints",
    clause: "`constraint(position = …)`, `constraint(velocity = …)`",
    cells: &[
        ("fix", shown("tests/tests/constraints/linkages/mod.rs", "the_loop_stays_closed_for_a_hundred_thousand_steps")),
        (
            "ada",
            shown(
                "tests/tests/constraints/linkages/rows.rs",
                "singular_positions_are_passed_on_the_branch_by_which_a_motion_comes",
            ),
        ),
        (
            "tay",
            shown(
                "tests/tests/constraints/linkages/rows.rs",
                "energy_is_kept_where_digits_are_lost_or_the_run_ends_with_the_reason",
            ),
        ),
        ("ros", shown("tests/tests/stiff/main.rs", "constraints_are_kept")),
        (
            "imp",
            shown("gauss-runtime/src/integrate/structure/collocation_tests.rs", "constraints_hold_and_the_order_stays"),
        ),
        ("evt", shown("tests/tests/touching/main.rs", "impacts_under_constraints_are_those_of_the_solved_system")),
        (
            "stp",
            shown("crates/gauss-contact/tests/many/driven.rs", "friction_along_a_driven_coordinate_is_at_its_bound")
                .but("slots refuse a kernel with constraints that its speeds do not solve, while it compiles"),
        ),
        (
            "one",
            together("constraints::by_hand")
                .but("by `OneStep::step` nothing brings the state back onto the constraints: `project` does, when it is called"),
        ),
        ("lan", shown("tests/tests/runs/batch/mod.rs", "constraints_hold_in_every_lane")),
        ("thr", together("constraints::lanes_and_threads")),
        (
            "at",
            shown("gauss-runtime/src/integrate/drive/runs/between_tests.rs", "what_is_between_satisfies_constraints"),
        ),
        ("tab", together("constraints::table_and_plot")),
        ("plt", together("constraints::table_and_plot")),
        ("pag", together("constraints::page")),
        (
            "mon",
            shown(
                "gauss-runtime/src/integrate/drive/acceptance/projection_tests.rs",
                "momenta_are_kept_on_the_constraints_as_well",
            )
            .but("of a constraint that moves with time the work is left in the residual"),
        ),
        (
            "fwd",
            shown(
                "crates/gauss-sensitivity/tests/derivatives/linkages.rs",
                "a_loop_has_the_derivatives_of_the_motion_without_it",
            ),
        ),
        ("adj", shown("crates/gauss-sensitivity/tests/derivatives/linkages.rs", "gradients_pass_through_projections")),
        ("lin", shown("tests/tests/derivatives/linearize.rs", "constraints_with_multipliers")),
        (
            "dst",
            shown("tests/tests/derivatives/discrete.rs", "constraints_with_multipliers")
                .but("before the state is brought back onto the constraints"),
        ),
        (
            "run",
            together("constraints::along_a_run")
                .but("what `project` does between two steps has no part in the product"),
        ),
        ("stu", together("constraints::study")),
        ("py", shown("examples/python/tests/test_runs.py", "test_causes_are_told_in_words_of_python")),
    ],
};

pub const REDUNDANT: Row = Row {
    name: "Constraints that depend on one another",
    clause: "`redundant`",
    cells: &[
        ("fix", together("redundant::steps")),
        (
            "ada",
            shown("tests/tests/constraints/linkages/redundant.rs", "a_door_on_three_hinges_swings_as_about_an_axle"),
        ),
        ("tay", refused(REDUNDANT_HAS_NO_SERIES)),
        ("ros", together("redundant::stiff")),
        ("imp", together("redundant::implicit")),
        ("evt", shown("tests/tests/goes_together/contacts.rs", "redundant")),
        ("stp", shown("tests/tests/goes_together/contacts.rs", "redundant")),
        ("one", together("redundant::by_hand")),
        ("lan", together("redundant::lanes_and_threads")),
        ("thr", together("redundant::lanes_and_threads")),
        ("at", together("redundant::between")),
        ("tab", together("redundant::table_and_plot")),
        ("plt", together("redundant::table_and_plot")),
        ("pag", together("redundant::page")),
        ("mon", shown("tests/tests/constraints/linkages/redundant.rs", "bricards_mechanism_moves_as_in_closed_form")),
        ("fwd", together("redundant::of_runs")),
        ("adj", together("redundant::of_runs")),
        ("lin", together("redundant::at_a_state")),
        ("dst", together("redundant::of_a_step")),
        ("run", together("redundant::along_a_run")),
        ("stu", together("redundant::study")),
        ("py", shown("examples/python/tests/test_runs.py", "test_constraints_that_depend_on_one_another")),
    ],
};

pub const STATES: Row = Row {
    name: "States of elements",
    clause: "`states(thrust = (command - thrust) / lag)`",
    cells: &[
        (
            "fix",
            shown(
                "tests/tests/systems/elements_with_states/closed.rs",
                "an_oscillator_with_a_filter_is_a_matrix_exponential",
            )
            .but("by `Adams`"),
        ),
        ("ada", shown("tests/tests/systems/elements_with_states/beside.rs", "a_body_in_a_chart_has_states")),
        ("tay", shown("tests/tests/systems/elements_with_states/closed.rs", "a_lag_of_first_order_is_exact")),
        (
            "ros",
            shown(
                "tests/tests/systems/elements_with_states/closed.rs",
                "an_oscillator_with_a_filter_is_a_matrix_exponential",
            ),
        ),
        (
            "imp",
            shown(
                "tests/tests/systems/elements_with_states/closed.rs",
                "an_oscillator_with_a_filter_is_a_matrix_exponential",
            ),
        ),
        ("evt", shown("tests/tests/systems/elements_with_states/beside.rs", "states_go_on_through_impacts")),
        (
            "stp",
            refused(
                "a step takes forces once, at its half; rates of states have no such rule: `ContactErrorKind::States`",
            )
            .by("tests/tests/systems/elements_with_states/beside.rs", "steps_of_one_length_refuse_states"),
        ),
        ("one", together("states::by_hand")),
        ("lan", shown("tests/tests/systems/elements_with_states/beside.rs", "packs_have_states")),
        ("thr", together("states::lanes_and_threads")),
        ("at", shown("examples/hull_memory/tests.rs", "states_are_the_convolution_over_the_run")),
        ("tab", together("states::table_and_plot")),
        ("plt", together("states::table_and_plot")),
        ("pag", together("states::page")),
        (
            "mon",
            shown(
                "tests/tests/systems/elements_with_states/derivatives.rs",
                "energy_is_balanced_and_forces_are_those_of_the_elements",
            ),
        ),
        ("fwd", together("states::of_runs")),
        ("adj", together("states::of_runs")),
        ("lin", shown("tests/tests/systems/elements_with_states/derivatives.rs", "linearize_is_the_matrix")),
        ("dst", together("states::of_a_step")),
        ("run", together("states::along_a_run")),
        ("stu", together("states::study")),
        ("py", shown("examples/python/tests/test_runs.py", "test_states_of_elements_and_tables")),
    ],
};

pub const MODES: Row = Row {
    name: "Bodies that bend",
    clause: "`modes(panel, …)`",
    cells: &[
        ("fix", together("modes::steps")),
        ("ada", shown("tests/tests/systems/flexible/beam.rs", "what_no_force_acts_on_keeps_its_momenta")),
        ("tay", together("modes::series")),
        ("ros", together("modes::stiff")),
        ("imp", together("modes::implicit")),
        ("evt", shown("tests/tests/goes_together/contacts.rs", "modes")),
        ("stp", shown("tests/tests/goes_together/contacts.rs", "modes")),
        ("one", together("modes::by_hand")),
        ("lan", together("modes::lanes_and_threads")),
        ("thr", together("modes::lanes_and_threads")),
        ("at", shown("tests/tests/systems/flexible/spin.rs", "a_beam_that_spins_up_lags_and_comes_back")),
        ("tab", together("modes::table_and_plot")),
        ("plt", together("modes::table_and_plot")),
        ("pag", together("modes::page")),
        ("mon", together("modes::energy")),
        ("fwd", together("modes::of_runs")),
        ("adj", together("modes::of_runs")),
        ("lin", shown("tests/tests/systems/flexible/beam.rs", "a_free_spacecraft_has_the_frequencies_of_its_beams")),
        ("dst", together("modes::of_a_step")),
        ("run", together("modes::along_a_run")),
        ("stu", together("modes::study")),
        ("py", shown("crates/gauss-py/tests/test_runs.py", "test_beams_bend")),
    ],
};

pub const TABLE_OF_ONE: Row = Row {
    name: "Tables of one number",
    clause: "`table(lift, points = LIFT)`",
    cells: &[
        ("fix", together("table_of_one::steps")),
        ("ada", together("table_of_one::adaptive")),
        ("tay", refused(TABLES_HAVE_NO_SERIES)),
        ("ros", together("table_of_one::stiff")),
        ("imp", together("table_of_one::implicit")),
        ("evt", shown("tests/tests/goes_together/contacts.rs", "table_of_one")),
        ("stp", shown("tests/tests/goes_together/contacts.rs", "table_of_one")),
        ("one", together("table_of_one::by_hand")),
        ("lan", together("table_of_one::lanes_and_threads")),
        ("thr", together("table_of_one::lanes_and_threads")),
        ("at", together("table_of_one::between")),
        ("tab", together("table_of_one::table_and_plot")),
        ("plt", together("table_of_one::table_and_plot")),
        ("pag", together("table_of_one::page")),
        ("mon", together("table_of_one::energy")),
        ("fwd", together("table_of_one::of_runs")),
        ("adj", together("table_of_one::of_runs")),
        ("lin", shown("tests/tests/derivatives/functions.rs", "values_and_derivatives")),
        ("dst", together("table_of_one::of_a_step")),
        ("run", together("table_of_one::along_a_run")),
        ("stu", together("table_of_one::study")),
        ("py", shown("examples/python/tests/test_runs.py", "test_states_of_elements_and_tables")),
    ],
};

pub const TABLES: Row = Row {
    name: "Tables of two and three numbers",
    clause: "`table(lift, axes = [ALPHA, MACH], values = LIFT)`",
    cells: &[
        ("fix", together("table_of_two::steps")),
        ("ada", shown("tests/tests/derivatives/tables.rs", "a_run_by_a_table")),
        ("tay", refused(TABLES_HAVE_NO_SERIES)),
        ("ros", together("table_of_two::stiff")),
        ("imp", together("table_of_two::implicit")),
        ("evt", shown("tests/tests/goes_together/contacts.rs", "table_of_two")),
        ("stp", shown("tests/tests/goes_together/contacts.rs", "table_of_two")),
        ("one", together("table_of_two::by_hand")),
        ("lan", together("table_of_two::lanes_and_threads")),
        ("thr", together("table_of_two::lanes_and_threads")),
        ("at", together("table_of_two::between")),
        ("tab", together("table_of_two::table_and_plot")),
        ("plt", together("table_of_two::table_and_plot")),
        ("pag", together("table_of_two::page")),
        ("mon", together("table_of_two::energy")),
        ("fwd", together("table_of_two::of_runs")),
        ("adj", together("table_of_two::of_runs")),
        ("lin", shown("tests/tests/derivatives/tables.rs", "a_table_is_its_formula")),
        ("dst", together("table_of_two::of_a_step")),
        ("run", together("table_of_two::along_a_run")),
        ("stu", together("table_of_two::study")),
        (
            "py",
            shown("crates/gauss-py/tests/test_tables.py", "test_forces_are_those_of_formulas").but("loaded kernels"),
        ),
    ],
};

const NO_SERIES: &str =
    "inputs arrive at run time, so that no power series is known beforehand: a compile error at `taylor`";

pub const INPUTS: Row = Row {
    name: "Inputs by a function",
    clause: "`input(thrust)` and `Simulation::input(|t, q, z| …)`",
    cells: &[
        (
            "fix",
            shown("gauss-runtime/src/monitor/balance.rs", "energy_is_what_was_supplied_up_to_the_quadrature")
                .but("a push that is shorter than the distance of stages is not seen; no message tells"),
        ),
        ("ada", shown("crates/gauss-contact/tests/laws/pushes.rs", "a_body_at_rest_without_contacts_is_pushed_too")),
        ("tay", refused(NO_SERIES).by("tests/compile_fail/taylor.rs", "main")),
        ("ros", shown("tests/tests/stiff/main.rs", "orders_in_every_chart_with_feedback")),
        ("imp", shown("gauss-runtime/src/integrate/structure/collocation_tests.rs", "orders_in_both_forms")),
        ("evt", shown("tests/tests/touching/main.rs", "a_motor_holds_a_pendulum_at_its_stop")),
        (
            "stp",
            shown("crates/gauss-contact/tests/many/spinning.rs", "gains_of_a_controller_are_held_for_a_step")
                .but("held for a step"),
        ),
        ("one", together("input::by_hand")),
        ("lan", shown("tests/tests/runs/batch/ensembles.rs", "pushes_that_are_over_soon_are_seen_in_every_lane")),
        ("thr", together("input::lanes_and_threads")),
        (
            "at",
            shown(
                "gauss-runtime/src/integrate/drive/runs/between_tests.rs",
                "between_samples_the_order_is_that_of_the_method",
            ),
        ),
        ("tab", shown("crates/gauss-tables/tests/table.rs", "columns_have_names_and_csv_reads_back")),
        ("plt", together("input::table_and_plot")),
        ("pag", together("input::page")),
        ("mon", shown("gauss-runtime/src/monitor/balance.rs", "energy_is_what_was_supplied_up_to_the_quadrature")),
        ("fwd", shown("crates/gauss-sensitivity/tests/derivatives/groups.rs", "backward_is_forward")),
        ("adj", shown("crates/gauss-sensitivity/tests/derivatives/groups.rs", "backward_is_forward")),
        ("lin", shown("tests/tests/derivatives/linearize.rs", "groups_and_scalars")),
        ("dst", shown("tests/tests/derivatives/discrete.rs", "groups_and_scalars").but("held for the step")),
        ("run", shown("tests/tests/derivatives/discrete.rs", "steps_after_one_another").but("held for each step")),
        ("stu", together("input::study")),
        ("py", shown("examples/python/tests/test_runs.py", "test_inputs")),
    ],
};

pub const RECORDED: Row = Row {
    name: "Inputs by a table of samples",
    clause: "a recording behind `InputSource`; in Python a pair (times, values)",
    cells: &[
        ("fix", together("recorded::steps")),
        (
            "ada",
            shown(
                "examples/recorded_inputs/tests.rs",
                "a_replay_agrees_with_equations_by_hand_and_with_the_closed_form",
            )
            .but("a run for each interval between two rows, where the input has its corners"),
        ),
        ("tay", refused(NO_SERIES).by("tests/compile_fail/taylor.rs", "main")),
        ("ros", together("recorded::stiff")),
        ("imp", together("recorded::implicit")),
        ("evt", shown("tests/tests/goes_together/contacts.rs", "recorded_push")),
        (
            "stp",
            shown("examples/trotting/tests.rs", "it_trots_and_recorded_torques_give_the_same_bits")
                .but("a row for each step"),
        ),
        ("one", together("recorded::by_hand")),
        ("lan", together("recorded::lanes_and_threads")),
        ("thr", together("recorded::lanes_and_threads")),
        ("at", together("recorded::between")),
        ("tab", together("recorded::table_and_plot")),
        ("plt", together("recorded::table_and_plot")),
        ("pag", together("recorded::page")),
        ("mon", together("recorded::energy")),
        ("fwd", together("recorded::of_runs")),
        (
            "adj",
            shown("crates/gauss-sensitivity/tests/derivatives/memory.rs", "the_number_of_checkpoints_changes_no_bit")
                .but("samples that are held, a number for each interval"),
        ),
        ("lin", moot("it takes the value of the input, wherever that comes from")),
        ("dst", moot("it takes the value that is held, wherever that comes from")),
        ("run", together("recorded::along_a_run")),
        ("stu", together("recorded::study")),
        ("py", shown("examples/python/tests/test_runs.py", "test_inputs")),
    ],
};
