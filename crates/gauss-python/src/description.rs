//! Description of a scene without a kernel: its parameters, coordinates, speeds and inputs in words.

/// A field of the struct: a keyword of the class.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// Its unit; empty where none is written.
    pub unit: &'static str,
    /// Its doc comment; empty where there is none.
    pub documentation: &'static str,
    /// Shape of its values.
    pub shape: Shape,
}

/// Shapes of the values of fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// An array of these axes, none of a number; matrices row by row.
    Array(&'static [usize]),
    /// A unit quaternion x, y, z, w.
    Rotation,
    /// Mass, centre of mass and inertia about O: a mapping of Python.
    Body,
}

impl Shape {
    /// Count of its numbers.
    #[must_use]
    pub fn size(self) -> usize {
        match self {
            Self::Array(axes) => axes.iter().product(),
            Self::Rotation => 4,
            Self::Body => 1 + 3 + 9,
        }
    }
}

/// A coordinate, a speed or an input by name: one number or several.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Its name.
    pub name: &'static str,
    /// Count of its numbers.
    pub size: usize,
    /// Number of these, in the beginning, whose squares add up to 1.
    pub unit: usize,
    /// Description in words, with its unit where that is known.
    pub label: &'static str,
}

/// Something to know of the file that a scene comes from.
#[derive(Clone, Copy, Debug)]
pub struct Remark {
    /// Text of the remark, with its place in the file.
    pub text: &'static str,
    /// Whether something that acts in the file does not act in the equations.
    pub ignored: bool,
}

/// All that is known of a scene.
#[derive(Clone, Debug)]
pub struct Description {
    /// The name of the struct and of the class.
    pub name: &'static str,
    /// The doc comment of the struct.
    pub documentation: &'static str,
    /// The fields of the struct, in order.
    pub fields: Vec<Field>,
    /// Coordinates, in the order of the struct's clauses.
    pub coordinates: Vec<Part>,
    /// Speeds, in their order.
    pub speeds: Vec<Part>,
    /// Inputs, in their order.
    pub inputs: Vec<Part>,
    /// Remarks on its file.
    pub remarks: Vec<Remark>,
}

impl Description {
    /// Parts of the configuration, with the place of the first number of each: scalars are behind all others.
    pub fn configuration(&self) -> impl Iterator<Item = (usize, &Part)> {
        let of = |scalar: bool| self.coordinates.iter().filter(move |part| (part.size == 1) == scalar);
        of(false).chain(of(true)).scan(0, |next, part| {
            let place = *next;
            *next += part.size;
            Some((place, part))
        })
    }

    /// Blocks of a configuration whose squares add up to 1: the first number, and how many.
    pub fn unit_blocks(&self) -> impl Iterator<Item = (usize, usize)> {
        self.configuration().filter(|(_, part)| part.unit > 0).map(|(place, part)| (place, part.unit))
    }

    /// The field that a number of the parameters is in, by its name as in Rust (`m`, `center[2]`, `arm.inertia[1][0]`),
    /// and its place there.
    pub fn place_of(&self, number: &str) -> Option<(usize, usize)> {
        let (path, indices) = number.find('[').map_or((number, ""), |at| number.split_at(at));
        let indices = indices.split(['[', ']']).filter(|word| !word.is_empty()).map(|word| word.parse().ok());
        let indices: Vec<usize> = indices.collect::<Option<_>>()?;
        let (name, part) = path.split_once('.').unwrap_or((path, ""));
        let field = self.fields.iter().position(|field| field.name == name)?;
        let (first, axes): (usize, &[usize]) = match (self.fields[field].shape, part) {
            (Shape::Array(axes), "") => (0, axes),
            (Shape::Body, "mass") => (0, &[]),
            (Shape::Body, "center_of_mass") => (1, &[3]),
            (Shape::Body, "inertia") => (4, &[3, 3]),
            _ => return None,
        };
        let place = indices.iter().zip(axes).fold(0, |place, (index, axis)| place * axis + index);
        (indices.len() == axes.len()).then_some((field, first + place))
    }

    /// Count of the numbers of the input.
    #[must_use]
    pub fn input_size(&self) -> usize {
        self.inputs.iter().map(|part| part.size).sum()
    }
}
