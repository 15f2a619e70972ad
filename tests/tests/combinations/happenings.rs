//! Rows of what happens in a run: samples of controllers, events, jumps, stops, contacts, slots.

use super::cells::{Row, missing, moot, refused, shown, together};

const AT_A_STATE: &str = "it happens in a run; the equations at a state have no part of it";
const WITH_CONTACTS: &str = "crates/gauss-contact/tests/many/sampled.rs";
const JUMPS_OF_CONTACTS: &str = "crates/gauss-contact/tests/jumps.rs";
const SALTATION: &str = "crates/gauss-sensitivity/tests/saltation.rs";

pub const SAMPLED: Row = Row {
    name: "Controllers that sample",
    clause: "`Simulation::sampled(period, |t, q, z| …)`",
    cells: &[
        ("fix", shown("tests/tests/runs/sampled.rs", "one_run_has_the_bits_of_a_loop_of_runs")),
        ("ada", shown("tests/tests/runs/sampled.rs", "one_run_has_the_bits_of_a_loop_of_runs")),
        (
            "tay",
            refused("it needs an input, and inputs have no power series: a compile error at `taylor`")
                .by("tests/compile_fail/taylor.rs", "main"),
        ),
        ("ros", together("sampled::stiff")),
        ("imp", together("sampled::implicit")),
        ("evt", shown(WITH_CONTACTS, "from_event_to_event")),
        ("stp", shown(WITH_CONTACTS, "in_steps_of_any_length")),
        ("one", together("sampled::one_by_one")),
        (
            "lan",
            shown("crates/gauss-batch/tests/sampled_lanes.rs", "every_run_has_the_bits_of_its_own")
                .but("`Ensemble`; `Batch::advance` has none"),
        ),
        ("thr", shown("crates/gauss-batch/tests/sampled_lanes.rs", "every_run_has_the_bits_of_its_own")),
        ("at", shown("tests/tests/runs/sampled.rs", "states_between_have_the_input_that_was_held")),
        ("tab", shown("tests/tests/runs/sampled.rs", "tables_tell_what_was_held")),
        ("plt", together("sampled::table_and_plot")),
        ("pag", together("sampled::page")),
        ("mon", shown("tests/tests/runs/sampled.rs", "the_balance_of_energy_is_that_of_what_was_held")),
        ("fwd", shown("tests/tests/runs/sampled.rs", "derivatives_pass_through_samples").but("in dual numbers")),
        (
            "adj",
            shown("crates/gauss-sensitivity/tests/sampled.rs", "a_cart_has_the_derivatives_of_its_recursion")
                .but("`Run::period`: laws of the state at each sample, without a memory of their own"),
        ),
        ("lin", moot(AT_A_STATE)),
        (
            "dst",
            shown("tests/tests/derivatives/discrete.rs", "differences_of_the_same_step")
                .but("the step of an input that is held"),
        ),
        ("run", shown("tests/tests/derivatives/discrete.rs", "steps_after_one_another")),
        ("stu", together("sampled::study")),
        (
            "py",
            shown("examples/python/tests/test_methods.py", "test_controllers_hold_from_instant_to_instant")
                .but("`ensemble` has none"),
        ),
    ],
};

pub const EVENTS: Row = Row {
    name: "Events",
    clause: "`event(…)`, `until(…)`",
    cells: &[
        (
            "fix",
            shown(
                "gauss-runtime/src/integrate/drive/events/event_tests.rs",
                "events_are_as_accurate_as_the_method_and_lie_on_zero",
            ),
        ),
        (
            "ada",
            shown(
                "gauss-runtime/src/integrate/drive/events/event_tests.rs",
                "events_are_as_accurate_as_the_method_and_lie_on_zero",
            ),
        ),
        (
            "tay",
            shown(
                "tests/tests/runs/taylor/runs.rs",
                "events_and_states_between_samples_have_the_accuracy_of_the_method",
            ),
        ),
        ("ros", together("event::stiff")),
        ("imp", shown("tests/tests/runs/events.rs", "a_ball_bounces_by_every_method")),
        (
            "evt",
            shown(
                "crates/gauss-contact/tests/laws/marks.rs",
                "functions_of_the_user_are_found_between_impacts_and_at_them",
            ),
        ),
        (
            "stp",
            shown("crates/gauss-contact/tests/many/front.rs", "steps_find_events_of_the_user")
                .but("between the ends of steps; what passes there and back within one is not seen"),
        ),
        ("one", together("event::one_by_one")),
        ("lan", shown("tests/tests/runs/batch/ensembles.rs", "events_are_those_of_each_run")),
        (
            "thr",
            shown("examples/python/tests/test_runs.py", "test_ensembles_have_parameters_and_ends_of_their_own")
                .but("an end, through Python; `ContactEnsemble` has none"),
        ),
        (
            "at",
            shown(
                "gauss-runtime/src/integrate/drive/runs/between_tests.rs",
                "samples_apart_events_and_both_directions",
            ),
        ),
        ("tab", together("event::table_and_plot")),
        ("plt", together("event::table_and_plot")),
        ("pag", together("event::page")),
        ("mon", together("event::energy")),
        (
            "fwd",
            shown(
                "crates/gauss-sensitivity/tests/derivatives/events.rs",
                "the_period_of_a_pendulum_has_derivatives_by_length_gravity_and_amplitude",
            ),
        ),
        (
            "adj",
            shown(
                "crates/gauss-sensitivity/tests/derivatives/events.rs",
                "the_period_of_a_pendulum_has_derivatives_by_length_gravity_and_amplitude",
            )
            .but("the event that ends the run"),
        ),
        ("lin", moot(AT_A_STATE)),
        ("dst", moot("a step ends at the time that it is given; an event within it is not looked for")),
        (
            "run",
            shown(SALTATION, "a_run_that_an_event_ends_has_the_derivative_of_its_time")
                .but("`Saltation` of `gauss-sensitivity`"),
        ),
        ("stu", shown("guide/src/studies.md", "main")),
        ("py", shown("examples/python/tests/test_methods.py", "test_events_do_not_end_a_run")),
    ],
};

pub const JUMPS: Row = Row {
    name: "Jumps of the state",
    clause: "`event(…).then(|state| …)`, `then_through`",
    cells: &[
        ("fix", shown("tests/tests/runs/events.rs", "a_ball_bounces_by_every_method")),
        ("ada", shown("tests/tests/runs/events.rs", "a_ball_bounces_by_every_method")),
        ("tay", shown("tests/tests/runs/events.rs", "a_ball_bounces_by_every_method")),
        ("ros", together("jump::stiff")),
        ("imp", shown("tests/tests/runs/events.rs", "a_ball_bounces_by_every_method")),
        ("evt", shown(JUMPS_OF_CONTACTS, "a_blow_sets_what_sticks_sliding")),
        (
            "stp",
            shown(JUMPS_OF_CONTACTS, "walls_of_ones_own_fold_the_way_of_a_block")
                .but("the step ends at the event, by the states that steps reach"),
        ),
        ("one", together("jump::one_by_one")),
        ("lan", shown("tests/tests/runs/events.rs", "runs_in_lanes_pile_up_and_are_told_as_alone")),
        ("thr", together("jump::threads")),
        ("at", shown("tests/tests/runs/events.rs", "a_ball_bounces_by_every_method")),
        ("tab", together("jump::table_and_plot")),
        ("plt", together("jump::table_and_plot")),
        ("pag", shown("crates/gauss-playback/tests/playback/page.rs", "a_jump_is_a_jump")),
        ("mon", together("jump::energy")),
        (
            "fwd",
            shown(
                "tests/tests/derivatives/duals/events.rs",
                "times_of_impacts_and_the_flight_after_them_have_derivatives",
            )
            .but("in dual numbers; by `Run::jump` of `gauss-sensitivity` as well"),
        ),
        (
            "adj",
            shown(
                "crates/gauss-sensitivity/tests/jumps.rs",
                "backward_and_forward_are_dual_numbers_through_the_same_run",
            ),
        ),
        ("lin", moot(AT_A_STATE)),
        ("dst", moot("a step ends at the time that it is given; no jump is within it")),
        (
            "run",
            shown(SALTATION, "the_product_over_bounces_is_the_derivative_by_the_initial_state")
                .but("`Saltation` of `gauss-sensitivity`"),
        ),
        ("stu", together("jump::study")),
        (
            "py",
            shown("examples/python/tests/test_contacts.py", "test_a_wall_of_ones_own_turns_back")
                .but("`ensemble` has none"),
        ),
    ],
};

const FALLS_THROUGH: &str = "without the forces of its contacts bodies would fall through floors and joints pass their \
                             stops: `IntegrationErrorKind::Contacts`, or `without_contacts()` on purpose";
const BY_HAND: &str = "tests/tests/touching/by_hand.rs";
const REFUSES_BY_HAND: &str = "steps_by_hand_refuse_contacts";
const FREE_STEP: &str = "`IntegrationErrorKind::Contacts`, or `without_contacts()` on purpose; `Batch::accelerations` \
                         refuses as well, and adapters (`FlatSystem`) while they compile; `ContactStepper` has the \
                         forces";
const FREE_DERIVATIVES: &str = "`InMode` with `gauss_adapters::linearize`; of the kernel the derive refuses: \
                                `derivatives_leave_contacts_out_on_purpose`";
const FREE_STEP_DERIVATIVES: &str = "by `step_with_derivatives`; `step_linearized` needs `linearize`, which the derive \
                                     refuses but for `linearize(without_contacts)`";
const IN_PYTHON: &str = "what has forces in it, functions of JAX too, raises `ContactError`: `in_contact`, or `without_contacts()` on purpose";

pub const RANGES: Row = Row {
    name: "Ranges and dry friction",
    clause: "`range(knee, from = 0, to = 2.4)`, `dry_friction(hinge, bound = f)`",
    cells: &[
        ("fix", refused(FALLS_THROUGH)),
        ("ada", refused(FALLS_THROUGH)),
        ("tay", refused(FALLS_THROUGH)),
        ("ros", refused(FALLS_THROUGH)),
        ("imp", refused(FALLS_THROUGH)),
        ("evt", shown("tests/tests/touching/main.rs", "a_motor_holds_a_pendulum_at_its_stop")),
        ("stp", shown("crates/gauss-contact/tests/many/several.rs", "a_leg_between_its_stops_gains_little")),
        ("one", refused(FREE_STEP).by(BY_HAND, REFUSES_BY_HAND)),
        (
            "lan",
            shown(
                "crates/gauss-contact/tests/many/driven.rs",
                "lanes_and_derivatives_have_friction_along_driven_coordinates",
            ),
        ),
        ("thr", shown(TOUCHING, "ranges_on_threads_have_the_bits_of_one")),
        ("at", shown("tests/tests/touching/main.rs", "a_motor_holds_a_pendulum_at_its_stop").but("by events")),
        ("tab", shown(TOUCHING, "ranges_in_tables_and_plots")),
        ("plt", shown(TOUCHING, "ranges_in_tables_and_plots")),
        ("pag", shown(TOUCHING, "ranges_in_pages")),
        ("mon", shown(TOUCHING, "energy_between_stops_is_accounted_for").but("by events")),
        ("fwd", shown(TOUCHING, "places_between_stops_have_derivatives").but("by events, in dual numbers")),
        ("adj", refused(FALLS_THROUGH)),
        (
            "lin",
            refused(FREE_DERIVATIVES)
                .by("gauss-codegen/src/model/tests/systems/contacts.rs", "derivatives_leave_contacts_out_on_purpose"),
        ),
        (
            "dst",
            shown(
                "crates/gauss-contact/src/steps/derivatives_tests.rs",
                "stops_dry_joints_and_rods_have_the_derivatives_of_differences",
            )
            .but(FREE_STEP_DERIVATIVES),
        ),
        ("run", shown("examples/hop_mpc/tests.rs", "plans_hop_on_after_a_blow_and_thrusts_alone_do_not")),
        ("stu", shown(TOUCHING, "ranges_in_rows_of_studies")),
        ("py", shown("examples/python/tests/test_contacts.py", "test_ranges_and_dry_friction").but(IN_PYTHON)),
    ],
};

pub const CONTACTS: Row = Row {
    name: "Contacts",
    clause: "`contact(foot, point = tip, friction = mu)`, `ground(…)`, `self_contact(…)`",
    cells: &[
        (
            "fix",
            refused(FALLS_THROUGH).by("tests/tests/touching/main.rs", "runs_without_contact_forces_refuse_contacts"),
        ),
        (
            "ada",
            refused(FALLS_THROUGH).by("tests/tests/touching/main.rs", "runs_without_contact_forces_refuse_contacts"),
        ),
        ("tay", refused(FALLS_THROUGH)),
        ("ros", refused(FALLS_THROUGH)),
        (
            "imp",
            refused(FALLS_THROUGH).by("tests/tests/touching/main.rs", "runs_without_contact_forces_refuse_contacts"),
        ),
        ("evt", shown("tests/tests/touching/main.rs", "a_sliding_ball_begins_to_roll")),
        ("stp", shown("crates/gauss-contact/tests/laws/steps.rs", "a_box_falls_on_a_corner_and_lies_down")),
        ("one", refused(FREE_STEP).by(BY_HAND, REFUSES_BY_HAND)),
        (
            "lan",
            shown("crates/gauss-contact/tests/many/lanes.rs", "a_lane_has_the_bits_of_a_stepper_of_its_own")
                .but("`Batch` refuses: `ensembles_refuse_contacts` in `tests/tests/touching/main.rs`"),
        ),
        (
            "thr",
            shown(
                "crates/gauss-contact/tests/many/lanes.rs",
                "an_ensemble_has_the_bits_of_single_runs_on_one_thread_and_on_all",
            ),
        ),
        (
            "at",
            shown(
                "crates/gauss-contact/tests/laws/turning.rs",
                "a_ball_that_spins_on_its_place_stops_when_drilling_has_taken_its_momentum",
            )
            .but("by events; in steps `both_records_are_read_alike`"),
        ),
        ("tab", shown("tests/tests/touching/history.rs", "tables_take_runs_by_events_and_in_steps_alike")),
        ("plt", shown(TOUCHING, "contacts_in_tables_and_plots")),
        (
            "pag",
            shown("crates/gauss-playback/tests/playback/contact.rs", "contacts_have_places_modes_and_forces")
                .but("by events; in steps `the_plane_of_a_slope_is_drawn`"),
        ),
        (
            "mon",
            shown("tests/tests/touching/history.rs", "what_friction_and_impacts_take_is_what_is_lost")
                .but("by events; of steps `report.work` and `unexplained`"),
        ),
        (
            "fwd",
            shown("tests/tests/derivatives/duals/contacts.rs", "bounces_have_the_derivatives_of_their_closed_form")
                .but("by events, in dual numbers; `gauss-sensitivity` refuses, `contacts_are_refused`"),
        ),
        (
            "adj",
            refused(FALLS_THROUGH)
                .but(ADJOINT_OF_CONTACTS)
                .by("crates/gauss-sensitivity/tests/derivatives/mistakes.rs", "contacts_are_refused"),
        ),
        (
            "lin",
            shown("tests/tests/derivatives/duals/contacts.rs", "a_system_is_linearised_in_its_mode")
                .but(FREE_DERIVATIVES),
        ),
        (
            "dst",
            shown(
                "crates/gauss-contact/src/steps/derivatives_tests.rs",
                "a_tossed_crate_has_the_derivatives_of_differences",
            )
            .but(FREE_STEP_DERIVATIVES),
        ),
        ("run", shown("examples/trot_regulator/tests.rs", "gains_from_derivatives_of_steps_hold_a_trot")),
        ("stu", shown(TOUCHING, "contacts_in_rows_of_studies")),
        ("py", shown("examples/python/tests/test_contacts.py", "test_from_event_to_event").but(IN_PYTHON)),
    ],
};

const TOUCHING: &str = "tests/tests/goes_together/touching.rs";
const SCALARS_OF_SLOTS: &str = "crates/gauss-contact/tests/slots_in_scalars.rs";
const ADJOINT_OF_CONTACTS: &str = "runs of `gauss-sensitivity` have no impacts, so that bodies would fall \
                                through floors: `IntegrationErrorKind::Contacts`";
const OF_SLOTS: &str = "`Slots` have no such trait: a compile error";

pub const SLOTS: Row = Row {
    name: "Slots",
    clause: "`Slots`, shapes of `gauss-parry`: contacts that come at run time",
    cells: &[
        ("fix", refused(FALLS_THROUGH)),
        ("ada", refused(FALLS_THROUGH)),
        ("tay", refused(OF_SLOTS)),
        ("ros", refused(OF_SLOTS)),
        ("imp", refused(FALLS_THROUGH)),
        ("evt", shown("crates/gauss-contact/tests/slots.rs", "exact_runs_and_steps_move_as_with_the_clause")),
        ("stp", shown("crates/gauss-parry/tests/scenes/arm.rs", "an_arm_pushes_a_box_over_a_table")),
        ("one", refused(FREE_STEP)),
        ("lan", shown(SCALARS_OF_SLOTS, "lanes_of_slots_have_the_bits_and_the_data_of_single_ones")),
        ("thr", shown(SCALARS_OF_SLOTS, "threads_of_slots_have_the_bits_of_one")),
        ("at", shown(TOUCHING, "states_of_slots_between_samples")),
        ("tab", shown(TOUCHING, "slots_in_tables_and_plots")),
        ("plt", shown(TOUCHING, "slots_in_tables_and_plots")),
        ("pag", shown(TOUCHING, "slots_in_pages")),
        ("mon", shown(SCALARS_OF_SLOTS, "energy_of_slots_is_accounted_for").but("by events; of steps `report.work`")),
        ("fwd", shown(SCALARS_OF_SLOTS, "runs_of_slots_have_derivatives").but("by events, in dual numbers")),
        (
            "adj",
            refused(ADJOINT_OF_CONTACTS)
                .by(TOUCHING, "whole_runs_of_slots_are_not_differentiated_without_their_forces"),
        ),
        (
            "lin",
            shown(SCALARS_OF_SLOTS, "slots_in_their_modes_have_derivatives_at_a_state").but("`InMode` in dual numbers"),
        ),
        (
            "dst",
            shown(SCALARS_OF_SLOTS, "steps_of_slots_have_the_derivatives_of_the_clause")
                .but("by `step_with_derivatives`; `step_linearized` needs `linearize`, which slots have not"),
        ),
        ("run", shown(SCALARS_OF_SLOTS, "steps_of_slots_after_one_another_are_a_run")),
        ("stu", shown(TOUCHING, "slots_in_rows_of_studies")),
        ("py", missing("there is no class for them")),
    ],
};
