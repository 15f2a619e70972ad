//! Runs of a model: in the smallest room that it fits into.
//!
//! Integrators know sizes when they are compiled. There is one for each of a few rooms; numbers that the model does not
//! have are zero there, stand still, and are taken out of all that leaves the run or asks its functions. Tolerances are
//! those of the model's own numbers ([`System::share`]).

use std::sync::Arc;

use gauss_jit::{Kernel, MixedConfiguration, System, SystemWithContacts};
use gauss_runtime::integrate::{
    Absent, EstimatingStep, JacobianMethod, MethodPlace, NoTaylor, StepOutcome, StepSetting,
};
use gauss_runtime::prelude::{Configuration, GaussSystem, SVector};

use crate::methods::Sizes;
use crate::steps::{
    self, AnyStepper, Control, Effect, Event, Held, InContact, Input, Jumped, Outcome, OwnStepper, Request, Stoppable,
    Until, Watched, components, lacks, no_contacts, numbers_of, smooth, touching, vector,
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
    match needs_no_jacobian(kernel, request)? && least(sizes) > 64 {
        true => in_room!(kernel, least(sizes), |system| {
            in_its_room(&system, sizes, request, |q, request| smooth::<_, Absent, NoTaylor>(&system, q, request))
        }; 128),
        false => in_room!(kernel, least(sizes), |system| {
            in_its_room(&system, sizes, request, |q, request| smooth::<_, JacobianMethod, NoTaylor>(&system, q, request))
        }; 4 8 16 32 64),
    }
}

/// Whether the method needs no Jacobian: matrices over more than 64 states are too large for the stacks of threads.
///
/// # Errors
/// A method that the model has not.
fn needs_no_jacobian(kernel: &Kernel, request: &Request<'_>) -> Result<bool, String> {
    let Control::Smooth(method, _) = request.control else { return Err(no_contacts()) };
    match method.clause() {
        Some("taylor") => Err(format!("the method {method} is one of compiled kernels")),
        Some(clause) if !kernel.model().methods().any(|name| name == clause) => Err(lacks(method.name(), clause)),
        clause => Ok(clause.is_none()),
    }
}

/// A run step by step, and the kernel that it borrows.
struct OwnSteps {
    /// Dropped before the kernel.
    stepper: Box<dyn AnyStepper>,
    room: usize,
    counts: [usize; 2],
    _kernel: Arc<Kernel>,
}

/// A run step by step.
///
/// # Errors
/// A model that is too large; what [`smooth`] refuses.
#[allow(unsafe_code)]
pub fn stepper(kernel: &Kernel, sizes: &Sizes, request: &Request<'_>) -> Result<Box<dyn AnyStepper>, String> {
    let own = Arc::new(kernel.without_contacts());
    // SAFETY: the kernel is not moved or changed, and dropped after the stepper, which gives no part of it away.
    let kernel: &'static Kernel = unsafe { &*Arc::as_ptr(&own) };
    let (stepper, room) = match needs_no_jacobian(kernel, request)? && least(sizes) > 64 {
        true => in_room!(kernel, least(sizes), |system| begun::<Absent, _, _>(system, sizes, request); 128),
        false => in_room!(kernel, least(sizes), |system| {
            begun::<JacobianMethod, _, _>(system, sizes, request)
        }; 4 8 16 32 64),
    }?;
    Ok(Box::new(OwnSteps { stepper, room, counts: [sizes.configuration, sizes.speeds], _kernel: own }))
}

/// The steps in the numbers of the room, and that room.
fn begun<R, const N: usize, const CONSTRAINED: bool>(
    system: InRoom<'static, N, CONSTRAINED>,
    sizes: &Sizes,
    request: &Request<'_>,
) -> Result<(Box<dyn AnyStepper>, usize), String>
where
    R: MethodPlace<JacobianMethod> + EstimatingStep<Stoppable<'static, InRoom<'static, N, CONSTRAINED>>> + 'static,
    OwnStepper<InRoom<'static, N, CONSTRAINED>, R, NoTaylor>: Send,
{
    in_room_of(&system, sizes, request, |q, request| Ok((steps::stepper::<_, R, NoTaylor>(system, q, request)?, N)))
}

impl AnyStepper for OwnSteps {
    fn step(&mut self) -> Result<StepOutcome, String> {
        self.stepper.step()
    }

    fn act(&mut self, input: &[f64]) -> Result<(), String> {
        self.stepper.act(input)
    }

    fn state(&self) -> Vec<f64> {
        own_numbers(&self.stepper.state(), self.room, self.counts)
    }

    fn at(&self, t: f64) -> Result<Vec<f64>, String> {
        Ok(own_numbers(&self.stepper.at(t)?, self.room, self.counts))
    }

    fn counts(&self) -> [u64; 2] {
        self.stepper.counts()
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
    let outcome = in_room_of(system, sizes, request, run)?;
    Ok(without_room(outcome, N, [sizes.configuration, sizes.speeds]))
}

/// A run whose functions have the model's own numbers.
fn in_room_of<T, const N: usize, const CONSTRAINED: bool>(
    system: &InRoom<'_, N, CONSTRAINED>,
    sizes: &Sizes,
    request: &Request<'_>,
    run: impl FnOnce(MixedConfiguration<N>, &Request<'_>) -> Result<T, String>,
) -> Result<T, String> {
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
    run(system.configuration(request.q).renormalise(), &request)
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
fn without_room(outcome: Outcome, room: usize, counts: [usize; 2]) -> Outcome {
    let row = |row: &[f64]| own_numbers(row, room, counts);
    let columns = outcome.columns.chunks(outcome.rows.max(1)).enumerate();
    let columns = columns.filter(|(place, _)| is_own(*place, room, counts));
    Outcome {
        columns: columns.flat_map(|(_, column)| column).copied().collect(),
        last: row(&outcome.last),
        events: outcome.events.iter().map(|event| Event { number: event.number, row: row(&event.row) }).collect(),
        ..outcome
    }
}

/// Whether the number at a place in a row of time, q, z and what follows is the model's own.
fn is_own(place: usize, room: usize, [q, z]: [usize; 2]) -> bool {
    match place {
        0 => true,
        place if place <= room => place <= q,
        place if place <= 2 * room => place - room <= z,
        _ => true,
    }
}

/// A row without room.
fn own_numbers(row: &[f64], room: usize, counts: [usize; 2]) -> Vec<f64> {
    let numbers = row.iter().enumerate().filter(|(place, _)| is_own(*place, room, counts));
    numbers.map(|(_, number)| *number).collect()
}
