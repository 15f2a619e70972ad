//! What a scene holds goes with what is done with it: each scene through each column of `docs/combinations.md`.
//!
//! Numbers are compared with runs at tolerances of 1e-12, derivatives with differences of such runs, lanes, threads and
//! steps by hand with the bits of single runs.

mod contacts;
mod derivatives;
mod happenings;
mod records;
mod runs;
mod scenes;
mod touching;

use happenings::{Event, Jump, Sampled};
use scenes::{Bending, Burning, Constrained, Input, Recorded, Redundant, Stateful, TableOfOne, TableOfTwo};

/// A module for each scene with a test for each column.
macro_rules! goes_together {
    ($($row:ident $scene:ident: $($module:ident::{$($column:ident),+}),+;)+) => {$(
        mod $row {
            use super::*;

            $($(
                #[test]
                fn $column() {
                    $module::$column(&$scene);
                }
            )+)+
        }
    )+};
}

goes_together! {
    mass Burning:
        runs::{steps, several_steps, adaptive, series, stiff, implicit, lanes_and_threads, by_hand, between},
        records::{table_and_plot, page, study, energy},
        derivatives::{of_runs, at_a_state, of_a_step, along_a_run};
    constraints Constrained:
        runs::{lanes_and_threads, by_hand},
        records::{table_and_plot, page, study},
        derivatives::{along_a_run};
    redundant Redundant:
        runs::{steps, several_steps, adaptive, stiff, implicit, lanes_and_threads, by_hand, between},
        records::{table_and_plot, page, study},
        derivatives::{of_runs, at_a_state, of_a_step, along_a_run};
    states Stateful:
        runs::{lanes_and_threads, by_hand, between},
        records::{table_and_plot, page, study},
        derivatives::{of_runs, at_a_state, of_a_step, along_a_run};
    modes Bending:
        runs::{steps, several_steps, adaptive, series, stiff, implicit, lanes_and_threads, by_hand, between},
        records::{table_and_plot, page, study, energy},
        derivatives::{of_runs, at_a_state, of_a_step, along_a_run};
    table_of_one TableOfOne:
        runs::{steps, several_steps, adaptive, stiff, implicit, lanes_and_threads, by_hand, between},
        records::{table_and_plot, page, study, energy},
        derivatives::{of_runs, at_a_state, of_a_step, along_a_run};
    table_of_two TableOfTwo:
        runs::{steps, several_steps, adaptive, stiff, implicit, lanes_and_threads, by_hand, between},
        records::{table_and_plot, page, study, energy},
        derivatives::{of_runs, at_a_state, of_a_step, along_a_run};
    input Input:
        runs::{lanes_and_threads, by_hand},
        records::{table_and_plot, page, study};
    recorded Recorded:
        runs::{steps, stiff, implicit, lanes_and_threads, by_hand, between},
        records::{table_and_plot, page, study, energy},
        derivatives::{of_runs, along_a_run};
    event Event:
        happenings::{one_by_one, stiff, table_and_plot, page, energy};
    jump Jump:
        happenings::{one_by_one, stiff, table_and_plot, energy, study, threads};
    sampled Sampled:
        happenings::{one_by_one, stiff, implicit, table_and_plot, page, study};
}
