//! The class of all kernels; each struct gets a subclass of its name ([`make`](crate::make)).

use std::sync::Arc;

use pyo3::exceptions::{PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};

use numpy::{PyArray1, PyArrayDyn, PyArrayMethods};

use crate::arrays;
use crate::errors;
use crate::kernels::{AnyKernel, AnyScene};
use crate::parameters;
use crate::tuples;

/// The scene of a class, as its attribute `_scene`.
#[pyclass(frozen, module = "gauss_python")]
pub struct SceneHandle {
    scene: Arc<dyn AnyScene>,
}

impl SceneHandle {
    /// The attribute of the class of a scene.
    pub fn new(scene: Arc<dyn AnyScene>) -> Self {
        Self { scene }
    }
}

/// The scene of a class.
fn scene_of(class: &Bound<'_, PyType>) -> PyResult<Arc<dyn AnyScene>> {
    let handle = class.getattr(pyo3::intern!(class.py(), "_scene"));
    match handle.ok().and_then(|handle| handle.cast_into::<SceneHandle>().ok()) {
        Some(handle) => Ok(Arc::clone(&handle.get().scene)),
        None => Err(PyTypeError::new_err("Kernel is the base of the classes of scenes, and none itself")),
    }
}

/// A kernel: parameters checked, constants computed once. It never changes, so that threads may share it.
#[pyclass(subclass, frozen, module = "gauss_python")]
pub struct Kernel {
    kernel: Arc<dyn AnyKernel>,
    /// All gaps are open, by the caller's word, and nothing rubs.
    open: bool,
}

impl Kernel {
    /// The kernel, its type forgotten.
    pub fn kernel(&self) -> &dyn AnyKernel {
        &*self.kernel
    }

    /// The kernel, to be kept.
    pub fn shared(&self) -> Arc<dyn AnyKernel> {
        Arc::clone(&self.kernel)
    }

    /// Its scene.
    pub fn scene(&self) -> &dyn AnyScene {
        self.kernel.scene()
    }

    /// Whether contacts act, of which only runs know the forces.
    pub fn touches(&self) -> bool {
        !self.open && !self.scene().contacts().is_empty()
    }

    /// Refuses to answer what forces do where those of contacts are among them.
    pub fn knows_all_forces(&self, py: Python<'_>, (what, way): (&str, &str)) -> PyResult<()> {
        if !self.touches() {
            return Ok(());
        }
        let contacts = self.contact_names();
        let message = format!(
            "{what} has no forces of contacts, and the scene has {}: `in_contact` and `simulate` have them; with `{way}` \
             all gaps are open, and nothing rubs",
            contacts.join(", ")
        );
        Err(errors::new(py, "ContactError", message, ("contacts", contacts)))
    }

    /// The number of a frame.
    pub fn frame(&self, name: &str) -> PyResult<usize> {
        self.number(name, self.scene().frames(), ("frame", "frames"))
    }

    /// The number of a joint whose reaction is a method.
    pub fn joint(&self, name: &str) -> PyResult<usize> {
        self.number(name, self.scene().joints(), ("joint", "reactions"))
    }

    fn number(&self, name: &str, all: &[&str], (what, clause): (&str, &str)) -> PyResult<usize> {
        let scene = self.scene().description().name;
        if all.is_empty() {
            return Err(PyTypeError::new_err(format!(
                "{scene} has no {what}s: its struct does not say `#[gauss({clause}(…))]`; models of `gauss.load` take \
                 `clauses=[\"{clause}(…)\"]`"
            )));
        }
        all.iter().position(|other| *other == name).ok_or_else(|| {
            let all = all.join(", ");
            PyKeyError::new_err(format!("{scene} has no {what} {name}; those of `{clause}(…)`: {all}"))
        })
    }
}

/// The word for open gaps among parameters, which is no name of a field.
const OPEN: &str = "_without_contacts";

#[pymethods]
impl Kernel {
    #[new]
    #[classmethod]
    #[pyo3(signature = (**parameters))]
    fn new(class: &Bound<'_, PyType>, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let (py, scene) = (class.py(), scene_of(class)?);
        let parameters = parameters.map(|parameters| parameters.copy()).transpose()?;
        let open = match &parameters {
            Some(parameters) => parameters.call_method1("pop", (OPEN, false))?.is_truthy()?,
            None => false,
        };
        Ok(Self { kernel: parameters::kernel(py, &scene, parameters.as_ref())?.into(), open })
    }

    /// The same kernel with all gaps open, and without dry friction: its accelerations, derivatives, runs and functions
    /// of JAX are those of the motion without forces of contacts.
    fn without_contacts<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let parameters = slf.get().parameters(slf.py())?;
        parameters.set_item(OPEN, true)?;
        slf.get_type().call((), Some(&parameters))
    }

    /// The acceleration, what contacts, ranges and dry joints do ("open", "closed", "sticks", "slides") and their
    /// forces at a state: normal, tangents and spin of each by its name. A gap that is closing is refused, since
    /// velocities jump there.
    #[pyo3(signature = (q, z, input=None, *, t=0.0))]
    fn in_contact<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        z: &Bound<'py, PyAny>,
        input: Option<&Bound<'py, PyAny>>,
        t: f64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (scene, sizes) = (self.scene(), self.scene().sizes());
        let (q, z) = (arrays::vector("q", q, sizes.configuration)?, arrays::vector("z", z, sizes.speeds)?);
        let input = match input {
            Some(input) => arrays::vector("input", input, sizes.input)?,
            None if sizes.input == 0 => Vec::new(),
            None => return Err(PyTypeError::new_err("in_contact needs input")),
        };
        if !self.touches() {
            return Err(PyTypeError::new_err("no contacts act: acceleration has all forces"));
        }
        let found = py.detach(|| self.kernel().in_contact(t, (&q, &z), &input)).map_err(PyValueError::new_err)?;
        let (modes, forces) = (PyDict::new(py), PyDict::new(py));
        for (contact, mode) in scene.contacts().iter().zip(found.modes) {
            modes.set_item(contact.name, mode)?;
            forces.set_item(contact.name, PyArray1::from_slice(py, &found.forces[contact.rows()]))?;
        }
        let acceleration = PyArray1::from_vec(py, found.acceleration);
        tuples::new(py, tuples::IN_CONTACT, (acceleration, modes, forces).into_pyobject(py)?)
    }

    /// Whether contacts act, of which only runs know the forces.
    #[getter(_touches)]
    fn acts(&self) -> bool {
        self.touches()
    }

    /// The names of contacts, ranges and dry joints.
    #[getter]
    fn contact_names(&self) -> Vec<&'static str> {
        self.scene().contacts().iter().map(|contact| contact.name).collect()
    }

    /// The numbers of the parameters by which `by_parameters` differentiates, in the order of its columns; none without
    /// the clause `linearize(parameters)`.
    #[getter]
    fn parameter_names(&self) -> Vec<&'static str> {
        self.scene().parameters().to_vec()
    }

    /// The parameters by name.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        parameters::as_dict(py, self.kernel())
    }

    /// Remarks on what of the robot's file does not act in the equations, and on what is likely not meant, although a
    /// kernel can be made of it.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.kernel.warnings()
    }

    /// The equations of motion as they were derived.
    #[getter]
    fn equations(&self) -> &str {
        self.scene().equations()[0]
    }

    /// The equations in LaTeX.
    #[getter]
    fn latex(&self) -> &str {
        self.scene().equations()[1]
    }

    fn _repr_latex_(&self) -> String {
        format!("$$\n{}\n$$", self.scene().equations()[1])
    }

    /// Operations that every method costs, as text.
    #[getter]
    fn operations(&self) -> String {
        self.scene().operations()
    }

    /// Losses of methods to rounding, as text.
    #[getter]
    fn accuracy(&self) -> String {
        self.scene().accuracy()
    }

    /// The names of the numbers of q.
    #[getter]
    fn coordinate_names(&self) -> Vec<&'static str> {
        self.scene().names()[0].to_vec()
    }

    /// The names of the numbers of z.
    #[getter]
    fn speed_names(&self) -> Vec<&'static str> {
        self.scene().names()[1].to_vec()
    }

    /// The names of the numbers of the input.
    #[getter]
    fn input_names(&self) -> Vec<String> {
        let numbers = |part: &crate::Part| {
            let part = *part;
            (0..part.size).map(move |k| match part.size {
                1 => part.name.to_owned(),
                _ => format!("{}_{}", part.name, ["x", "y", "z"].get(k).unwrap_or(&"")),
            })
        };
        self.scene().description().inputs.iter().flat_map(numbers).collect()
    }

    /// The names of the frames.
    #[getter]
    fn frames(&self) -> Vec<&'static str> {
        self.scene().frames().to_vec()
    }

    /// The names of the joints whose reactions are methods.
    #[getter]
    fn joints(&self) -> Vec<&'static str> {
        self.scene().joints().to_vec()
    }

    /// The names of the driven coordinates, in the order of `driving_forces`.
    #[getter]
    fn motions(&self) -> Vec<&'static str> {
        self.scene().motions().to_vec()
    }

    /// Number of speeds.
    #[getter]
    fn dof(&self) -> usize {
        self.scene().sizes().speeds
    }

    /// The arrays q and z of a state: coordinates and speeds by name, whole ones or their numbers; what is not named
    /// is at rest in the origin.
    #[pyo3(signature = (**named))]
    fn state<'py>(
        &self,
        py: Python<'py>,
        named: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<[Bound<'py, PyArrayDyn<f64>>; 2]> {
        let scene = self.scene();
        let mut numbers = scene.at_rest();
        for (name, value) in named.into_iter().flat_map(|named| named.iter()) {
            let name: String = name.extract()?;
            place(scene, &name, &arrays::numbers(&name, &value)?.0, &mut numbers)?;
        }
        Ok(numbers.map(|numbers| PyArray1::from_vec(py, numbers).to_dyn().clone()))
    }

    /// The state q, z nearest to these, measured by the kinetic energy, that satisfies the constraints.
    #[pyo3(signature = (q, z, *, t=0.0))]
    fn project<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        z: &Bound<'py, PyAny>,
        t: f64,
    ) -> PyResult<[Bound<'py, PyArrayDyn<f64>>; 2]> {
        let sizes = self.scene().sizes();
        let (q, z) = (arrays::vector("q", q, sizes.configuration)?, arrays::vector("z", z, sizes.speeds)?);
        let found = self.kernel().project(t, &q, &z).map_err(PyValueError::new_err)?;
        Ok(found.map(|numbers| PyArray1::from_vec(py, numbers).to_dyn().clone()))
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let parameters = slf.get().parameters(slf.py())?;
        let words = parameters.iter().map(|(name, value)| {
            let value = if value.hasattr("tolist")? { value.call_method0("tolist")? } else { value };
            Ok(format!("{}={}", name.str()?, value.repr()?))
        });
        let words: PyResult<Vec<String>> = words.collect();
        let open = if slf.get().open { ".without_contacts()" } else { "" };
        Ok(format!("{}({}){open}", slf.get().scene().description().name, words?.join(", ")))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| {
            let (own, other, open) = (self.kernel(), other.get().kernel(), other.get().open);
            std::ptr::eq(own.scene().description(), other.scene().description())
                && own.numbers() == other.numbers()
                && self.open == open
        })
    }

    fn __hash__(&self) -> u64 {
        use std::hash::{DefaultHasher, Hash, Hasher};
        let mut hasher = DefaultHasher::new();
        self.scene().description().name.hash(&mut hasher);
        // Zeros of both signs are equal.
        self.kernel.numbers().iter().for_each(|number| (number + 0.0).to_bits().hash(&mut hasher));
        hasher.finish()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        // In all protocols, which `copyreg.__newobj_ex__` is not.
        let (py, partial) = (slf.py(), slf.py().import("functools")?.getattr("partial")?);
        let parameters = slf.get().parameters(py)?;
        if slf.get().open {
            parameters.set_item(OPEN, true)?;
        }
        let make = partial.call((slf.get_type(),), Some(&parameters))?;
        Ok((make, PyTuple::empty(py)))
    }
}

/// Puts the numbers of one name into a state.
pub fn place(scene: &dyn AnyScene, name: &str, values: &[f64], [q, z]: &mut [Vec<f64>; 2]) -> PyResult<()> {
    let description = scene.description();
    let mut speeds = 0;
    let of_speeds = description.speeds.iter().map(|part| {
        let first = speeds;
        speeds += part.size;
        (first, part)
    });
    let of_speeds: Vec<_> = of_speeds.collect();
    let find = |parts: &[(usize, &crate::Part)], names: &[&str]| {
        let whole = parts.iter().find(|(_, part)| part.name == name).map(|&(first, part)| (first, part.size));
        whole.or_else(|| names.iter().position(|other| *other == name).map(|place| (place, 1)))
    };
    let [coordinate_names, speed_names] = scene.names();
    let configuration: Vec<_> = description.configuration().collect();
    let (numbers, (first, size)) = match (find(&configuration, coordinate_names), find(&of_speeds, speed_names)) {
        (Some(found), _) => (q, found),
        (None, Some(found)) => (z, found),
        (None, None) => {
            let all = [coordinate_names, speed_names].concat().join(", ");
            return Err(PyTypeError::new_err(format!("no coordinate or speed is called {name}; there are {all}")));
        }
    };
    if values.len() != size {
        return Err(PyValueError::new_err(format!("{name} has {size} numbers, found {}", values.len())));
    }
    numbers[first..first + size].copy_from_slice(values);
    Ok(())
}
