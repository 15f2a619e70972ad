//! Runs of a model: in the smallest room that it fits into.
//!
//! Integrators know sizes when they are compiled. There is one for each of a few rooms; numbers that the model does not
//! have are zero there, stand still, and are taken out of all that leaves the run or asks its functions. Tolerances are
//! those of the model's own numbers ([`System::share`]).

use gauss_jit::{Kernel, MixedConfiguration, System, SystemWithContacts};
use gauss_runtime::integrate::{Absent, JacobianMethod, NoTaylor, StepSetting};
use gauss_runtime::prelude::{Configuration, GaussSystem, SVector};

use crate::methods::Sizes;
use crate::steps::{
    self, Control, Effect, Event, Held, InContact, Input, Jumped, Outcome, Request, Until, Watched, components, lacks,
    no_contacts, numbers_of, smooth, touching, vector,
};

/// A system with room for N numbers of each kind.
type InRoom<'k, const N: usize, const CONSTRAINED: bool> = System<'k, N, N, SVector<f64, N>, CONSTRAINED>;
/// The same with R rows of contacts.
type WithContacts<'k, const N: usize, const R: usize, const CONSTRAINED: bool> =
    SystemWithContacts<'k, N, N, SVector<f64, N>, R, CONSTRAINED>;

/// Calls a function with the first system that has room for a model with constraints or without.
macro_rules! in_first {
    ($kernel:expr, $least:expr, |$system:ident| $value:expr; $(
        $room:expr => $free:ty = $by:ident, $constrained:ty = $by_constrained:ident
    );+) => {{
        let (least, is_constrained) = ($least, $kernel.model().description().is_constrained);
        let fits = |room: [usize; 2]| least.iter().zip(room).all(|(own, room)| *own <= room);
        $(
            if fits($room) && !is_constrained {
                let $system: $free = $kernel.$by().map_err(|error| error.to_string())?;
                $value
            } else if fits($room) {
                let $system: $constrained = $kernel.$by_constrained().map_err(|error| error.to_string())?;
                $value
            } else
        )+ {
            let most = [$($room),+].into_iter().fold([0; 2], |most, room| [most[0].max(room[0]), most[1].max(room[1])]);
            Err(too_large(most, least))
        }
    }};
}

/// The same without contacts.
macro_rules! in_room {
    ($kernel:expr, $least:expr, |$system:ident| $value:expr; $($room:literal)+) => {
        in_first!($kernel, [$least, 0], |$system| $value; $(
            [$room, 0] => InRoom<'_, $room, false> = system, InRoom<'_, $room, true> = constrained_system
        );+)
    };
    ($kernel:expr, $least:expr, |$system:ident| $value:expr) => {
        in_room!($kernel, $least, |$system| $value; 4 8 16 32 64 128)
    };
}

/// The same with contacts, in rooms of which each is code of its own for two ways of running.
macro_rules! in_contact_room {
    ($kernel:expr, $least:expr, |$system:ident| $value:expr) => {
        in_contact_room!($kernel, $least, |$system| $value; 8 24, 32 48, 64 96)
    };
    ($kernel:expr, $least:expr, |$system:ident| $value:expr; $($room:literal $rows:literal),+) => {
        in_first!($kernel, [$least, rows($kernel)], |$system| $value; $(
            [$room, $rows] => WithContacts<'_, $room, $rows, false> = contact_system,
                WithContacts<'_, $room, $rows, true> = constrained_contact_system
        );+)
    };
}

/// Why no room is large enough.
fn too_large([most, most_rows]: [usize; 2], [least, rows]: [usize; 2]) -> String {
    let contacts = |rows: usize| if rows > 0 { format!(" and {rows} rows of contacts") } else { String::new() };
    format!(
        "such runs are of at most {most} numbers of q, of z and of the input{}, and this model has {least}{}",
        contacts(most_rows),
        contacts(rows)
    )
}

/// The rows of contacts of a model.
fn rows(kernel: &Kernel) -> usize {
    kernel.contacts().last().map_or(0, |contact| contact.rows().end)
}

/// The room that a model needs.
fn least(sizes: &Sizes) -> usize {
    [sizes.configuration, sizes.increment, sizes.speeds, sizes.input, sizes.multipliers].into_iter().fold(0, usize::max)
}

/// A run.
///
/// # Errors
/// A model that is too large; what [`smooth`] refuses.
pub fn simulate(kernel: &Kernel, sizes: &Sizes, request: &Request<'_>) -> Result<Outcome, String> {
    if let Control::ContactEvents(..) | Control::ContactSteps(..) = request.control {
        if kernel.contacts().is_empty() {
            return Err(no_contacts());
        }
        return in_contact_room!(kernel, least(sizes), |system| {
            in_its_room(system.system(), sizes, request, |q, request| touching(&system, q, request))
        });
    }
    let kernel = &kernel.without_contacts();
    let Control::Smooth(method, _) = request.control else { return Err(no_contacts()) };
    match method.clause() {
        Some("taylor") => return Err(format!("the method {method} is one of compiled kernels")),
        Some(clause) if !kernel.model().methods().any(|name| name == clause) => {
            return Err(lacks(method.name(), clause));
        }
        // Matrices over states of more are too large for the stacks of threads.
        None if least(sizes) > 64 => in_room!(kernel, least(sizes), |system| {
            in_its_room(&system, sizes, request, |q, request| smooth::<_, Absent, NoTaylor>(&system, q, request))
        }; 128),
        _ => in_room!(kernel, least(sizes), |system| {
            in_its_room(&system, sizes, request, |q, request| smooth::<_, JacobianMethod, NoTaylor>(&system, q, request))
        }; 4 8 16 32 64),
    }
}

/// The nearest state on the constraints.
///
/// # Errors
/// A model that is too large; no such state is found.
pub fn project(kernel: &Kernel, sizes: &Sizes, t: f64, (q, z): (&[f64], &[f64])) -> Result<[Vec<f64>; 2], String> {
    let kernel = &kernel.without_contacts();
    in_room!(kernel, least(sizes), |system| {
        let start = system.configuration(q).renormalise();
        let found = system.project(t, &start, &vector(z)).map_err(|error| error.to_string())?;
        Ok([own(&numbers_of(&found.0), q.len()), own(&components(&found.1), z.len())])
    })
}

/// Acceleration at a state, with modes and forces of the contacts.
///
/// # Errors
/// A model that is too large; a state at which velocities jump.
pub fn in_contact(
    kernel: &Kernel,
    sizes: &Sizes,
    t: f64,
    (q, z): (&[f64], &[f64]),
    input: &[f64],
) -> Result<InContact, String> {
    in_contact_room!(kernel, least(sizes), |system| {
        let start = system.system().configuration(q).renormalise();
        let found = steps::in_contact(&system, t, (start, z), input)?;
        Ok(InContact { acceleration: own(&found.acceleration, z.len()), ..found })
    })
}

fn own(numbers: &[f64], count: usize) -> Vec<f64> {
    numbers[..count].to_vec()
}

/// A run whose functions and results have the model's own numbers.
fn in_its_room<const N: usize, const CONSTRAINED: bool>(
    system: &InRoom<'_, N, CONSTRAINED>,
    sizes: &Sizes,
    request: &Request<'_>,
    run: impl FnOnce(MixedConfiguration<N>, &Request<'_>) -> Result<Outcome, String>,
) -> Result<Outcome, String> {
    let (configuration, speeds) = (sizes.configuration, sizes.speeds);
    let of_input = |t: f64, q: &[f64], z: &[f64]| match request.input {
        Input::Function(function) => function(t, &q[..configuration], &z[..speeds]),
        Input::Constant(_) | Input::Table(_) => Vec::new(),
    };
    let input = match request.input {
        Input::Constant(numbers) => Input::Constant(components(&vector::<SVector<f64, N>>(numbers))),
        Input::Table(_) if sizes.input == 0 => Input::Constant(vec![0.0; N]),
        Input::Table(table) => Input::Table(table.widened(sizes.input, N)),
        Input::Function(_) => Input::Function(&of_input),
    };
    let law = |t: f64, q: &[f64], z: &[f64]| match &request.controller {
        Some(held) => (held.law)(t, &q[..configuration], &z[..speeds]),
        None => Vec::new(),
    };
    let counts = [configuration, speeds];
    let functions: Vec<_> = request.until.iter().map(|until| (watch(until, counts), jump(until, counts))).collect();
    let until = request.until.iter().zip(&functions);
    let until: Vec<Until<'_>> = until
        .map(|(until, (watch, jump))| Until {
            watched: match until.watched {
                Watched::Number(place, value) if place < configuration => Watched::Number(place, value),
                Watched::Number(place, value) => Watched::Number(N + place - configuration, value),
                Watched::Function(_) => Watched::Function(watch),
            },
            crossing: until.crossing,
            effect: match until.effect {
                Effect::Jumps(_, through) => Effect::Jumps(jump, through),
                other => other,
            },
        })
        .collect();
    let share = system.share();
    let control = match request.control {
        Control::Smooth(method, StepSetting::Tolerant { relative, absolute, largest }) => {
            let (relative, absolute) = (tolerance(relative, share), absolute * share);
            Control::Smooth(method, StepSetting::Tolerant { relative, absolute, largest })
        }
        Control::ContactEvents(relative, absolute, largest, law) => {
            Control::ContactEvents(tolerance(relative, share), absolute * share, largest, law)
        }
        Control::ContactSteps(length, Some((relative, absolute)), scheme, law) => {
            let tolerances = (tolerance(relative, share), absolute * share);
            Control::ContactSteps(length, Some(tolerances), scheme, law)
        }
        other => other,
    };
    let controller = request.controller.as_ref();
    let controller = controller.map(|held| Held { period: held.period, delay: held.delay, law: &law });
    let request = Request { control, input: &input, controller, until: &until, ..*request };
    let outcome = run(system.configuration(request.q).renormalise(), &request)?;
    Ok(without_room(outcome, N, counts))
}

/// A relative tolerance of the model's own numbers; those below rounding were refused before.
fn tolerance(relative: f64, share: f64) -> f64 {
    (relative * share).max(f64::EPSILON)
}

/// The function of an event, of the model's own numbers.
fn watch<'a>(until: &'a Until<'_>, [q, z]: [usize; 2]) -> impl Fn(f64, &[f64], &[f64]) -> f64 + Sync + use<'a> {
    let function = if let Watched::Function(function) = until.watched { Some(function) } else { None };
    move |t, of_q, of_z| function.map_or(f64::NAN, |function| function(t, &of_q[..q], &of_z[..z]))
}

/// The jump of an event, of the model's own numbers.
fn jump<'a>(until: &'a Until<'_>, [q, z]: [usize; 2]) -> impl Fn(f64, &[f64], &[f64]) -> Jumped + Sync + use<'a> {
    let function = if let Effect::Jumps(function, _) = until.effect { Some(function) } else { None };
    move |t, of_q, of_z| function.and_then(|function| function(t, &of_q[..q], &of_z[..z]))
}

/// The run in the model's own numbers: of time, q, z and what follows, room is taken out.
fn without_room(outcome: Outcome, room: usize, [q, z]: [usize; 2]) -> Outcome {
    let is_own = |place: usize| match place {
        0 => true,
        place if place <= room => place <= q,
        place if place <= 2 * room => place - room <= z,
        _ => true,
    };
    let row = |row: &[f64]| {
        let numbers = row.iter().enumerate().filter(|(place, _)| is_own(*place));
        numbers.map(|(_, number)| *number).collect::<Vec<_>>()
    };
    let columns = outcome.columns.chunks(outcome.rows.max(1)).enumerate().filter(|(place, _)| is_own(*place));
    Outcome {
        columns: columns.flat_map(|(_, column)| column).copied().collect(),
        last: row(&outcome.last),
        events: outcome.events.iter().map(|event| Event { number: event.number, row: row(&event.row) }).collect(),
        ..outcome
    }
}
