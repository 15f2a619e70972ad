//! Long packed code as statements: vectors by functions of the runtime, line by line in blocks.

use std::collections::HashMap;

use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::packed::function;
use super::{
    BLOCK, Binding, Dialect, Line, NamedResults, angles_together, cosine, in_blocks, operand, pairs_read,
    row_of_angles, sine, statement, value,
};
use crate::algebra::{Key, joined};
use crate::program::{Code, Instruction, Operand, Pack, PackedCode, PackedStep, in_place};

/// Meaning of a name.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum NameMeaning {
    Value(usize),
    Sine(usize),
    Cosine(usize),
    Vector(usize),
    Gathered(usize),
}

impl NameMeaning {
    fn ident(self) -> Ident {
        let own = |letter: &str, k: usize| format_ident!("__{}{}", letter, k, span = Span::mixed_site());
        match self {
            NameMeaning::Value(k) => value(k),
            NameMeaning::Sine(k) => sine(k),
            NameMeaning::Cosine(k) => cosine(k),
            NameMeaning::Vector(k) => own("p", k),
            NameMeaning::Gathered(k) => own("g", k),
        }
    }

    fn of<S: Copy>(operand: Operand<S>) -> Option<Self> {
        match operand {
            Operand::Value(k) => Some(NameMeaning::Value(k)),
            Operand::Sine(k) => Some(NameMeaning::Sine(k)),
            Operand::Cosine(k) => Some(NameMeaning::Cosine(k)),
            Operand::Input(_) | Operand::Number(_) => None,
        }
    }
}

/// Lines, and where names are bound and read.
struct LaneWriter<'a, S, D> {
    code: &'a Code<S>,
    packed: &'a PackedCode<S>,
    dialect: &'a D,
    /// Paths of functions of vectors, by the number of lanes.
    functions: &'a dyn Fn(usize) -> TokenStream,
    of: Vec<Option<(usize, usize)>>,
    apart: Vec<bool>,
    /// Vectors that have a name, by their words.
    gathered: HashMap<u64, (Vec<Operand<S>>, usize)>,
    statements: Vec<Binding>,
    bound: HashMap<NameMeaning, usize>,
    /// The last line that reads a name.
    read: HashMap<NameMeaning, usize>,
}

/// The statements of packed code, and its outputs as expressions.
pub(crate) fn statements<S: Copy + Key, D: Dialect<S>>(
    code: &Code<S>,
    packed: &PackedCode<S>,
    dialect: &D,
    functions: &dyn Fn(usize) -> TokenStream,
) -> (TokenStream, Vec<TokenStream>) {
    let of = packed.places(code.instructions.len());
    let mut writer = LaneWriter {
        apart: taken_apart(code, packed, &of),
        code,
        packed,
        dialect,
        functions,
        of,
        gathered: HashMap::new(),
        statements: Vec::new(),
        bound: HashMap::new(),
        read: HashMap::new(),
    };
    let read = pairs_read(code, NamedResults::AsRead);
    packed.steps.iter().for_each(|step| writer.step(step, &read));
    code.outputs.iter().filter_map(|&output| NameMeaning::of(output)).for_each(|name| {
        writer.read.insert(name, usize::MAX);
    });
    let outputs = code.outputs.iter().map(|output| operand(output, dialect)).collect();
    (in_blocks(writer.lines()), outputs)
}

impl<S: Copy + Key, D: Dialect<S>> LaneWriter<'_, S, D> {
    fn line(&mut self, bound: impl IntoIterator<Item = NameMeaning>, statement: Binding) {
        bound.into_iter().for_each(|name| {
            self.bound.insert(name, self.statements.len());
        });
        self.statements.push(statement);
    }

    fn reads(&mut self, name: NameMeaning) {
        self.read.insert(name, self.statements.len());
    }

    fn step(&mut self, step: &PackedStep, read: &[[bool; 2]]) {
        match *step {
            PackedStep::Instruction(k) => {
                let instruction = &self.code.instructions[k];
                instruction.operands().filter_map(NameMeaning::of).for_each(|name| self.reads(name));
                let names = match instruction {
                    Instruction::SineCosine(_) => vec![NameMeaning::Sine(k), NameMeaning::Cosine(k)],
                    _ => vec![NameMeaning::Value(k)],
                };
                self.line(names, statement(k, instruction, read[k], self.dialect));
            }
            PackedStep::Angles(first, count) => {
                let angles = row_of_angles(self.code, first);
                angles.iter().filter_map(|&angle| NameMeaning::of(angle)).for_each(|name| self.reads(name));
                let function = self.dialect.sines_and_cosines().unwrap_or_default();
                let row = angles_together(first, &angles, &read[first..], &function, self.dialect);
                self.line((first..first + count).flat_map(|k| [NameMeaning::Sine(k), NameMeaning::Cosine(k)]), row);
            }
            PackedStep::Pack(p) => self.pack(p),
        }
    }

    fn pack(&mut self, p: usize) {
        let Pack { operation, lanes, operands } = &self.packed.packs[p];
        let operands: Vec<TokenStream> = operands.iter().map(|vector| self.vector(vector)).collect();
        let functions = (self.functions)(lanes.len());
        let (name, function) = (NameMeaning::Vector(p).ident(), function(*operation));
        self.line([NameMeaning::Vector(p)], Binding::new(&name, quote!(#functions::#function(#(#operands),*))));
        if self.apart[p] {
            self.reads(NameMeaning::Vector(p));
            let unused = (lanes.len()..lanes.len().next_power_of_two()).map(|_| quote!(_));
            let values = lanes.iter().map(|&k| value(k).into_token_stream()).chain(unused);
            let names: Vec<NameMeaning> = lanes.iter().map(|&k| NameMeaning::Value(k)).collect();
            self.line(names, Binding::new(quote!([#(#values),*]), quote!(#functions::lanes(#name))));
        }
    }

    /// An operand of a pack: a vector that is there, constants, a number in all lanes, or what is gathered, which has a
    /// name, as other packs may read it.
    fn vector(&mut self, operands: &[Operand<S>]) -> TokenStream {
        let functions = (self.functions)(operands.len());
        if let Some(p) = in_place(operands, &self.of) {
            self.reads(NameMeaning::Vector(p));
            let name = NameMeaning::Vector(p).ident();
            return quote!(#name);
        }
        let mut numbers: Vec<TokenStream> = operands.iter().map(|o| operand(o, self.dialect)).collect();
        // The fourth lane of three limbs is read by nobody.
        numbers.resize(numbers.len().next_power_of_two(), numbers[0].clone());
        let same = operands.iter().all(|operand| *operand == operands[0]);
        let first = &numbers[0];
        let written =
            if same { quote!(#functions::spread(#first)) } else { quote!(#functions::vector([#(#numbers),*])) };
        if operands.iter().all(|operand| NameMeaning::of(*operand).is_none()) {
            return written;
        }
        let word = operands.iter().fold(operands.len() as u64, |word, operand| joined(word, operand.word()));
        let known = self.gathered.get(&word).filter(|(known, _)| known == operands).map(|(_, number)| *number);
        let number = known.unwrap_or(self.statements.len());
        if known.is_none() {
            operands.iter().filter_map(|&operand| NameMeaning::of(operand)).for_each(|name| self.reads(name));
            self.line([NameMeaning::Gathered(number)], Binding::new(NameMeaning::Gathered(number).ident(), written));
            self.gathered.insert(word, (operands.to_vec(), number));
        }
        self.reads(NameMeaning::Gathered(number));
        let name = NameMeaning::Gathered(number).ident();
        quote!(#name)
    }

    /// Lines with the names that later blocks read.
    fn lines(self) -> Vec<Line> {
        let mut names: Vec<Vec<Ident>> = vec![Vec::new(); self.statements.len()];
        for (name, line) in &self.bound {
            if self.read.get(name).is_some_and(|reader| reader / BLOCK > line / BLOCK) {
                names[*line].push(name.ident());
            }
        }
        names.into_iter().zip(self.statements.into_iter().map(Some)).collect()
    }
}

/// Whether lanes of each pack are read one by one.
fn taken_apart<S: Copy + PartialEq>(
    code: &Code<S>,
    packed: &PackedCode<S>,
    of: &[Option<(usize, usize)>],
) -> Vec<bool> {
    let mut apart = vec![false; packed.packs.len()];
    let mut note = |operand: Operand<S>| {
        if let Operand::Value(k) = operand
            && let Some((pack, _)) = of[k]
        {
            apart[pack] = true;
        }
    };
    let single = code.instructions.iter().enumerate().filter(|(k, _)| of[*k].is_none());
    single.flat_map(|(_, instruction)| instruction.operands()).for_each(&mut note);
    let vectors = packed.packs.iter().flat_map(|pack| &pack.operands);
    vectors.filter(|vector| in_place(vector, of).is_none()).flatten().copied().for_each(&mut note);
    code.outputs.iter().copied().for_each(&mut note);
    apart
}

#[cfg(test)]
mod tests {
    use syn::{Block, Expr, Pat, Stmt};

    use super::*;
    use crate::algebra::{OwnFunction, Rational};
    use crate::program::Input;
    use crate::program::packs::tests::{limbs, of_limb};

    struct Named;

    impl Dialect<Input> for Named {
        fn input(&self, input: Input) -> TokenStream {
            let Input::Component { argument, component } = input else { return quote!(none) };
            let name = format_ident!("a{}_{}", argument, component);
            quote!(#name)
        }

        fn number(&self, value: &Rational) -> TokenStream {
            let value = value.to_f64();
            quote!(#value)
        }

        fn functions(&self) -> TokenStream {
            quote!(numbers)
        }

        fn own_function(&self, _: OwnFunction, _: &[TokenStream]) -> TokenStream {
            quote!(none)
        }

        fn apart(&self) -> Option<TokenStream> {
            None
        }
    }

    fn value_of(input: Input) -> f64 {
        match input {
            Input::Component { argument: 0, component } => 0.25 + 0.001 * component as f64,
            Input::Component { component, .. } => 0.7 - 1.9 * component as f64,
            Input::Number(_) => f64::NAN,
        }
    }

    /// Runs statements; a number is a list of one, a pair one of two.
    #[derive(Default)]
    struct Run(HashMap<String, Vec<f64>>);

    impl Run {
        fn block(&mut self, statements: &[Stmt]) {
            for statement in statements {
                match statement {
                    // Without a value: names that a block assigns.
                    Stmt::Local(local) => {
                        if let Some(init) = &local.init {
                            let value = self.value(&init.expr);
                            self.bind(&local.pat, &value);
                        }
                    }
                    Stmt::Expr(Expr::Block(inner), _) => self.block(&inner.block.stmts),
                    Stmt::Expr(Expr::Assign(assign), _) => {
                        let value = self.value(&assign.right);
                        let left = &assign.left;
                        let pattern = syn::parse::Parser::parse2(Pat::parse_single, quote!(#left)).expect("a pattern");
                        self.bind(&pattern, &value);
                    }
                    other => panic!("{}", other.to_token_stream()),
                }
            }
        }

        fn bind(&mut self, pattern: &Pat, value: &[f64]) {
            let mut each = |parts: &syn::punctuated::Punctuated<Pat, syn::Token![,]>| {
                assert_eq!(parts.len(), value.len());
                parts.iter().zip(value).for_each(|(part, number)| self.bind(part, &[*number]));
            };
            match pattern {
                Pat::Ident(name) => {
                    self.0.insert(name.ident.to_string(), value.to_vec());
                }
                Pat::Slice(parts) => each(&parts.elems),
                Pat::Tuple(parts) => each(&parts.elems),
                Pat::Wild(_) => {}
                other => panic!("{}", other.to_token_stream()),
            }
        }

        fn value(&self, e: &Expr) -> Vec<f64> {
            match e {
                Expr::Path(path) => {
                    let name = path.path.segments[0].ident.to_string();
                    self.0.get(&name).unwrap_or_else(|| panic!("{name} is read before it is bound")).clone()
                }
                Expr::Array(array) => array.elems.iter().flat_map(|e| self.value(e)).collect(),
                Expr::Unary(unary) => self.value(&unary.expr).iter().map(|x| -x).collect(),
                Expr::Binary(binary) => vec![self.value(&binary.left)[0] + self.value(&binary.right)[0]],
                Expr::Call(call) => {
                    let Expr::Path(path) = &*call.func else { panic!("no function") };
                    let name = path.path.segments.last().expect("a name").ident.to_string();
                    let given: Vec<Vec<f64>> = call.args.iter().map(|e| self.value(e)).collect();
                    let lanes = |of: &dyn Fn(&[f64]) -> f64| {
                        let lane = |k: usize| of(&given.iter().map(|vector| vector[k]).collect::<Vec<_>>());
                        (0..given[0].len()).map(lane).collect()
                    };
                    match name.as_str() {
                        "vector" | "lanes" => given[0].clone(),
                        "spread" => vec![given[0][0]; 2],
                        "sin_cos" => vec![given[0][0].sin(), given[0][0].cos()],
                        "product" => lanes(&|x| x[0] * x[1]),
                        "fma" | "product_plus" => lanes(&|x| x[0].mul_add(x[1], x[2])),
                        other => panic!("{other}"),
                    }
                }
                other => panic!("{}", other.to_token_stream()),
            }
        }
    }

    /// Statements compute what the code does, also where they are longer than a block.
    #[test]
    fn statements_compute_what_the_code_does() {
        for (terms, swapped) in [(20, false), (20, true), (700, true)] {
            let code = limbs(terms, swapped);
            let packed = code.with_limbs_together(of_limb(terms), &[]).expect("packs");
            let (written, outputs) = statements(&code, &packed, &Named, &|lanes| {
                assert_eq!(lanes, 2);
                quote!(two)
            });
            let block: Block = syn::parse2(quote!({ #written })).expect("statements");
            let mut run = Run::default();
            for input in code.inputs() {
                run.0.insert(Named.input(input).to_string(), vec![value_of(input)]);
            }
            run.block(&block.stmts);
            let found = outputs.into_iter().map(|output| run.value(&syn::parse2(output).expect("a value"))[0]);
            // Products are fused by the interpreter of code as well.
            for (found, expected) in found.zip(code.evaluate(value_of)) {
                assert!((found - expected).abs() <= 4.0 * f64::EPSILON * terms as f64 * expected.abs(), "{terms}");
            }
        }
    }
}
