//! Names of quantities in text and LaTeX: hats for observer's components, dots for rates.

use crate::algebra::Notation;

/// A name in both notations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    pub text: String,
    pub latex: String,
}

const HAT: char = '\u{302}';
const DOT: char = '\u{307}';
const TWO_DOTS: char = '\u{308}';

impl Name {
    pub fn new(text: &str, latex: &str) -> Self {
        Self { text: text.to_owned(), latex: latex.to_owned() }
    }

    pub fn print(&self, notation: Notation) -> &str {
        match notation {
            Notation::Text => &self.text,
            Notation::Latex => &self.latex,
        }
    }

    /// Q → Q̂: components in the observer's axes.
    pub fn hat(&self) -> Self {
        self.marked(HAT, "hat")
    }

    /// b → ḃ.
    pub fn dot(&self) -> Self {
        self.marked(DOT, "dot")
    }

    /// u → u1 for the component with index 0; of a name that has an index, a second one.
    pub fn index(&self, i: usize) -> Self {
        Self { text: format!("{}{}", self.text, i + 1), latex: self.with_index(&(i + 1).to_string()) }
    }

    /// p → p_θ; of a name that has an index, a second one.
    pub fn of(&self, other: &Self) -> Self {
        Self { text: format!("{}_{}", self.text, other.text), latex: self.with_index(&other.latex) }
    }

    /// The LaTeX with an index, which no name has two of: m_{1} of the arm is m_{1,arm}.
    fn with_index(&self, index: &str) -> String {
        match self.latex.strip_suffix('}') {
            Some(open) if self.latex.contains("_{") => format!("{open},{index}}}"),
            _ => format!("{}_{{{index}}}", self.latex),
        }
    }

    /// The derivative of a quasi-velocity: ḃ → b̈, ω → dω/dt. States at which programs are tried depend on the text.
    pub fn rate(&self) -> Self {
        let Some(latex) = self.latex.strip_prefix("\\dot{").map(|rest| format!("\\ddot{{{rest}")) else {
            return self.time_derivative();
        };
        match self.text.contains(DOT) {
            true => Self { text: self.text.replace(DOT, &TWO_DOTS.to_string()), latex },
            false => Self { latex, ..self.time_derivative() },
        }
    }

    /// As it is printed: dtheta_dot/dt → theta_ddot.
    pub fn printed_rate(self) -> Self {
        let word = self.text.strip_prefix('d').and_then(|rest| rest.strip_suffix("_dot/dt"));
        let text = word.map(|word| format!("{word}_ddot"));
        Self { text: text.unwrap_or(self.text), latex: self.latex }
    }

    /// Q → dQ/dt.
    pub fn time_derivative(&self) -> Self {
        Self { text: format!("d{}/dt", self.text), latex: format!("\\frac{{d}}{{dt}} {}", self.latex) }
    }

    /// A mark over the first letter.
    fn marked(&self, mark: char, command: &str) -> Self {
        let mut letters = self.text.chars();
        let text = letters.next().into_iter().chain([mark]).chain(letters).collect();
        // An index stays outside the braces: \hat{Q}_{1}. An underscore of a word is none.
        let (letter, index) = self.latex.split_at(self.latex.find("_{").unwrap_or(self.latex.len()));
        Self { text, latex: format!("\\{command}{{{letter}}}{index}") }
    }
}
