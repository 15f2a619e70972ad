//! `TaylorSystem`: power series in time: the recurrences of their coefficients, written out.
//!
//! With `x = Σ xₖ τᵏ` for everything that the program of the rates computes, coefficient by coefficient:
//!
//! | value | its coefficient of order k > 0 |
//! |---|---|
//! | c = a b | `a₀bₖ + aₖb₀ + Σ aⱼbₖ₋ⱼ` |
//! | c = a/b | `(aₖ − c₀bₖ − Σ cⱼbₖ₋ⱼ)/b₀` |
//! | c = √a | `(aₖ − Σ cⱼcₖ₋ⱼ)/2c₀` |
//! | e = exp a | `aₖe₀ + Σ jaⱼeₖ₋ⱼ/k` |
//! | l = ln a | `(aₖ − Σ jlⱼaₖ₋ⱼ/k)/a₀` |
//! | s = sin a, c = cos a | `aₖc₀ + Σ jaⱼcₖ₋ⱼ/k`, `−aₖs₀ − Σ jaⱼsₖ₋ⱼ/k` |
//! | w = tanh a, r = 1 − w² | `aₖr₀ + Σ jaⱼrₖ₋ⱼ/k`, `−2w₀wₖ − Σ wⱼwₖ₋ⱼ` |
//! | w = aᵖ | `(p(aₖw₀ + Σ jaⱼwₖ₋ⱼ/k) − Σ jwⱼaₖ₋ⱼ/k)/a₀` |
//! | θ = atan2(y, x), r = x² + y² | `(yₖx₀ − xₖy₀ + Σ (jyⱼxₖ₋ⱼ − jxⱼyₖ₋ⱼ − jθⱼrₖ₋ⱼ)/k)/r₀` |
//!
//! with sums over 0 < j < k (Knuth, TAOCP 2, 4.7). Each sum is a *lane* of the runtime's `Series`: all lanes of an
//! order are summed before its straight line begins. What is multiplied by constants or added costs one operation an
//! order.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::{BinaryFunction, Function, Map};
use crate::kernel::{Operand, Operation, Program};
use crate::mechanics::{Coordinate, Method};

use crate::emit::derived::Derived;
use crate::targets::rust::{Binding, NamedResults, in_blocks, operand, statements};

use crate::emit::dialect::program::{KernelDialect, ScalarTokens};

/// The number of lanes is a multiple of this: the runtime sums them in packs.
const PACK: usize = 4;

/// The straight line of one order.
struct Order<'a, 'g> {
    program: &'a Program<'g>,
    /// Order 0 of symbols, and order k of those that move.
    names: &'a Map<u32, TokenStream>,
    coefficients: &'a Map<u32, TokenStream>,
    scalar: &'a ScalarTokens<'a>,
    moving: Vec<bool>,
    /// Whether an instruction is added up within the one that reads it.
    inlined: Vec<bool>,
    /// The series that are factors, in order k.
    factors: Vec<TokenStream>,
    /// The two factors of each lane.
    lanes: Vec<[usize; 2]>,
    /// Statements that are computed once, after order 0.
    once: TokenStream,
}

fn indexed(prefix: &str, k: usize) -> Ident {
    format_ident!("__{}{}", prefix, k, span = Span::mixed_site())
}

impl<'a, 'g> Order<'a, 'g> {
    fn new(program: &'a Program<'g>, variables: &'a Variables, scalar: &'a ScalarTokens<'a>) -> Self {
        let Variables { first, coefficients, .. } = variables;
        Order {
            program,
            names: first,
            coefficients,
            scalar,
            moving: program.moving(|symbol| !coefficients.contains_key(&symbol.key())),
            inlined: program.added_once(),
            factors: Vec::new(),
            lanes: Vec::new(),
            once: TokenStream::new(),
        }
    }

    /// The statements of all that moves.
    fn line(&mut self) -> TokenStream {
        let mut lines = Vec::new();
        for (k, instruction) in self.program.instructions.iter().enumerate() {
            if self.moving[k] && !self.inlined[k] {
                let statements = self.statements(k, instruction);
                lines.extend(statements.into_iter().map(|(name, value)| {
                    let statement = Binding::new(&name, value);
                    (vec![name], Some(statement))
                }));
            }
        }
        in_blocks(lines)
    }

    /// Order 0.
    fn first(&self, o: &Operand<'g>) -> TokenStream {
        operand(o, &KernelDialect { symbols: self.names, scalar: self.scalar })
    }

    /// Order k; `None` where it is zero.
    fn coefficient(&self, o: &Operand<'g>) -> Option<TokenStream> {
        let moves = |k: usize| self.moving[k];
        match o {
            Operand::Number(_) => None,
            Operand::Input(symbol) => self.coefficients.get(&symbol.key()).cloned(),
            Operand::Value(k) if moves(*k) => Some(named("w", *k)),
            Operand::Sine(k) if moves(*k) => Some(named("ws", *k)),
            Operand::Cosine(k) if moves(*k) => Some(named("wc", *k)),
            _ => None,
        }
    }

    /// The sum over the products of two series; their coefficients of order k are given.
    fn lane(&mut self, left: TokenStream, right: TokenStream) -> TokenStream {
        let factors = [self.factor(left), self.factor(right)];
        self.lanes.push(factors);
        let lane = self.lanes.len() - 1;
        quote!(__sums[#lane])
    }

    /// The place of a series among the factors.
    fn factor(&mut self, coefficient: TokenStream) -> usize {
        let text = coefficient.to_string();
        self.factors.iter().position(|known| known.to_string() == text).unwrap_or_else(|| {
            self.factors.push(coefficient);
            self.factors.len() - 1
        })
    }

    /// The reciprocal of something of order 0, computed once.
    fn reciprocal(&mut self, k: usize, of: &TokenStream) -> TokenStream {
        let (name, real) = (indexed("r", k), &self.scalar.real);
        self.once.extend(quote!(let #name = #real::recip(#of);));
        quote!(#name)
    }

    /// Gathers the terms of an instruction that adds, with those that are added up for it alone.
    fn gather(&mut self, instruction: &Operation<'g>, negative: bool, sum: &mut Sum) {
        match instruction {
            Operation::Add(a, b) => {
                self.gather_operand(a, negative, sum);
                self.gather_operand(b, negative, sum);
            }
            Operation::Subtract(a, b) => {
                self.gather_operand(a, negative, sum);
                self.gather_operand(b, !negative, sum);
            }
            Operation::Negate(a) => self.gather_operand(a, !negative, sum),
            Operation::Multiply(a, b) => self.gather_product(a, b, negative, sum),
            Operation::MultiplyAdd(a, b, c) => {
                self.gather_product(a, b, negative, sum);
                self.gather_operand(c, negative, sum);
            }
            Operation::MultiplySubtract(a, b, c) => {
                self.gather_product(a, b, !negative, sum);
                self.gather_operand(c, negative, sum);
            }
            _ => {}
        }
    }

    fn gather_operand(&mut self, o: &Operand<'g>, negative: bool, sum: &mut Sum) {
        match o {
            Operand::Value(j) if self.inlined[*j] => {
                let program = self.program;
                self.gather(&program.instructions[*j], negative, sum);
            }
            _ => sum.terms.extend(self.coefficient(o).map(|term| signed(negative, term))),
        }
    }

    fn gather_product(&mut self, a: &Operand<'g>, b: &Operand<'g>, negative: bool, sum: &mut Sum) {
        let (a0, b0) = (self.first(a), self.first(b));
        let (ak, bk) = (self.coefficient(a), self.coefficient(b));
        if let (Some(ak), Some(bk)) = (&ak, &bk) {
            sum.terms.push(signed(negative, self.lane(ak.clone(), bk.clone())));
        }
        sum.products.extend(ak.map(|ak| (signed(negative, ak), b0)));
        sum.products.extend(bk.map(|bk| (signed(negative, bk), a0)));
    }

    /// Names and values of one instruction.
    fn statements(&mut self, k: usize, instruction: &Operation<'g>) -> Vec<(Ident, TokenStream)> {
        let fma = self.scalar.fma.clone();
        let (zero, w, v0) = (self.zero(), named("w", k), self.first(&Operand::Value(k)));
        let value = match instruction {
            Operation::Add(..)
            | Operation::Subtract(..)
            | Operation::Negate(_)
            | Operation::Multiply(..)
            | Operation::MultiplyAdd(..)
            | Operation::MultiplySubtract(..) => {
                let mut sum = Sum::default();
                self.gather(instruction, false, &mut sum);
                sum.write(&fma).unwrap_or(zero)
            }
            Operation::Divide(a, b) => self.quotient(k, a, b),
            Operation::Call(Function::Sqrt, a) => {
                let reciprocal = self.reciprocal(k, &quote!((#v0 + #v0)));
                let (sum, ak) = (self.lane(w.clone(), w.clone()), self.coefficient(a).unwrap_or(zero));
                quote!((#ak - #sum) * #reciprocal)
            }
            Operation::Call(Function::Ln, a) => {
                let (a0, ak) = (self.first(a), self.coefficient(a).unwrap_or(zero));
                let reciprocal = self.reciprocal(k, &a0);
                let sum = self.lane(quote!(#w * __order), ak.clone());
                quote!(#fma(-__over, #sum, #ak) * #reciprocal)
            }
            Operation::Call(Function::Tanh, a) => return self.tangent(k, a),
            Operation::Call(_, a) => {
                let ak = self.coefficient(a).unwrap_or(zero);
                let sum = self.lane(quote!(#ak * __order), w.clone());
                quote!(#fma(__over, #sum, #ak * #v0))
            }
            Operation::SineCosine(a) => return self.sine_cosine(k, a),
            Operation::Binary(BinaryFunction::Atan2, y, x) => return self.angle(k, y, x),
            Operation::Binary(BinaryFunction::Powf, a, p) => {
                let (a0, p, ak) = (self.first(a), self.first(p), self.coefficient(a).unwrap_or(zero));
                let reciprocal = self.reciprocal(k, &a0);
                let up = self.lane(quote!(#ak * __order), w.clone());
                let down = self.lane(quote!(#w * __order), ak.clone());
                quote!((#p * #fma(__over, #up, #ak * #v0) - __over * #down) * #reciprocal)
            }
            Operation::Binary(..) | Operation::Own(..) => {
                let message = "bug in gauss-derive: a function without a power series";
                quote!(::core::compile_error!(#message))
            }
        };
        vec![(indexed("w", k), value)]
    }

    fn quotient(&mut self, k: usize, a: &Operand<'g>, b: &Operand<'g>) -> TokenStream {
        let (fma, w, v0, divisor) =
            (self.scalar.fma.clone(), named("w", k), self.first(&Operand::Value(k)), self.first(b));
        let reciprocal = self.reciprocal(k, &divisor);
        let ak = self.coefficient(a).unwrap_or(self.zero());
        match self.coefficient(b) {
            Some(bk) => {
                let sum = self.lane(w, bk.clone());
                quote!(#fma(-#v0, #bk, #ak - #sum) * #reciprocal)
            }
            None => quote!(#ak * #reciprocal),
        }
    }

    fn sine_cosine(&mut self, k: usize, a: &Operand<'g>) -> Vec<(Ident, TokenStream)> {
        let (fma, ak) = (self.scalar.fma.clone(), self.coefficient(a).unwrap_or(self.zero()));
        let (s0, c0) = (self.first(&Operand::Sine(k)), self.first(&Operand::Cosine(k)));
        let (s, c) = (named("ws", k), named("wc", k));
        let with_cosine = self.lane(quote!(#ak * __order), c.clone());
        let with_sine = self.lane(quote!(#ak * __order), s.clone());
        let sine = quote!(#fma(__over, #with_cosine, #ak * #c0));
        let cosine = quote!(-#fma(__over, #with_sine, #ak * #s0));
        vec![(indexed("ws", k), sine), (indexed("wc", k), cosine)]
    }

    /// w = tanh a, r = 1 − w².
    fn tangent(&mut self, k: usize, a: &Operand<'g>) -> Vec<(Ident, TokenStream)> {
        let (fma, w, rk) = (self.scalar.fma.clone(), named("w", k), named("wr", k));
        let (w0, ak) = (self.first(&Operand::Value(k)), self.coefficient(a).unwrap_or(self.zero()));
        let with_rest = self.lane(quote!(#ak * __order), rk.clone());
        let squares = self.lane(w.clone(), w.clone());
        let tangent = quote!(#fma(__over, #with_rest, #ak * #fma(-#w0, #w0, __one)));
        let rest = quote!(-#fma(#w0 + #w0, #w, #squares));
        vec![(indexed("w", k), tangent), (indexed("wr", k), rest)]
    }

    /// atan2(y, x).
    fn angle(&mut self, k: usize, y: &Operand<'g>, x: &Operand<'g>) -> Vec<(Ident, TokenStream)> {
        let (fma, w, rk) = (self.scalar.fma.clone(), named("w", k), named("wr", k));
        let (x0, y0) = (self.first(x), self.first(y));
        let [xk, yk] = [x, y].map(|o| self.coefficient(o).unwrap_or(self.zero()));
        let reciprocal = self.reciprocal(k, &quote!((#x0 * #x0 + #y0 * #y0)));
        let x_squares = self.lane(xk.clone(), xk.clone());
        let y_squares = self.lane(yk.clone(), yk.clone());
        let forward = self.lane(quote!(#yk * __order), xk.clone());
        let back = self.lane(quote!(#xk * __order), yk.clone());
        let known = self.lane(quote!(#w * __order), rk.clone());
        let squares = quote!(#x_squares + #y_squares + ((#x0 + #x0) * #xk + (#y0 + #y0) * #yk));
        let angle = quote!(#fma(__over, #forward - #back - #known, #yk * #x0 - #xk * #y0) * #reciprocal);
        vec![(indexed("wr", k), squares), (indexed("w", k), angle)]
    }

    fn zero(&self) -> TokenStream {
        let (real, ty) = (&self.scalar.real, self.scalar.ty());
        quote!(<#ty as #real>::zero())
    }
}

/// Terms, and products of a number of order k and one of order 0, that are to be added up.
#[derive(Default)]
struct Sum {
    terms: Vec<TokenStream>,
    products: Vec<(TokenStream, TokenStream)>,
}

impl Sum {
    /// A tree, since the sums of one order wait for one another: two products and a term at each leaf.
    fn write(self, fma: &TokenStream) -> Option<TokenStream> {
        let mut terms = self.terms.into_iter();
        let mut leaves: Vec<TokenStream> = Vec::new();
        let mut products = self.products.into_iter();
        while let Some((a, b)) = products.next() {
            let inner = match products.next() {
                Some((c, d)) => Some(match terms.next() {
                    Some(term) => quote!(#fma(#c, #d, #term)),
                    None => quote!(#c * #d),
                }),
                None => terms.next(),
            };
            leaves.push(match inner {
                Some(inner) => quote!(#fma(#a, #b, #inner)),
                None => quote!(#a * #b),
            });
        }
        // Lanes that are left are known early.
        leaves.extend(terms);
        while leaves.len() > 1 {
            let mut pairs = leaves.into_iter();
            let mut sums = Vec::new();
            while let Some(a) = pairs.next() {
                sums.push(match pairs.next() {
                    Some(b) => quote!((#a + #b)),
                    None => a,
                });
            }
            leaves = sums;
        }
        leaves.pop()
    }
}

fn signed(negative: bool, term: TokenStream) -> TokenStream {
    if negative { quote!((-#term)) } else { term }
}

fn named(prefix: &str, k: usize) -> TokenStream {
    let name = indexed(prefix, k);
    quote!(#name)
}

/// All numbers that a state is made of, taken apart and named.
struct Variables {
    names: Vec<Ident>,
    declarations: TokenStream,
    /// Tokens of symbols in order 0, and of those that move in order k.
    first: Map<u32, TokenStream>,
    coefficients: Map<u32, TokenStream>,
}

impl Variables {
    fn of<'g>(derived: &Derived<'_, 'g>, program: &Program<'g>) -> Self {
        let (mut first, mut coefficients) = (derived.constant_names(program), Map::default());
        let time = derived.subject.system.scene.time;
        first.insert(time.key(), quote!(__t));
        coefficients.insert(time.key(), quote!(__time));
        let mut arguments = derived.subject.configuration_arguments(&derived.private());
        arguments.push(derived.vector_argument(quote!(__z), derived.speeds()));
        let (mut declarations, mut names) = (TokenStream::new(), Vec::new());
        for argument in &arguments {
            let start = names.len();
            for symbol in &argument.symbols {
                let (n, name) = (names.len(), indexed("q", names.len()));
                first.insert(symbol.key(), quote!(#name));
                coefficients.insert(symbol.key(), quote!(__x[#n]));
                names.push(name);
            }
            let (own, array) = (&names[start..], &argument.array);
            declarations.extend(quote!(let [#(#own),*] = #array;));
        }
        Variables { names, declarations, first, coefficients }
    }
}

/// The implementation, where the series are derived.
pub fn taylor_system(derived: &Derived<'_, '_>) -> Option<TokenStream> {
    let program = derived.program(Method::ComponentRates)?;
    let (private, scalar) = (derived.private(), derived.scalar());
    let (ty, real, zero) = (scalar.ty(), &scalar.real, quote!(__zero));
    let variables = Variables::of(derived, program);
    let (instructions, rates) =
        statements(program, &KernelDialect { symbols: &variables.first, scalar: &scalar }, NamedResults::Everything);
    let mut order = Order::new(program, &variables, &scalar);
    let line = order.line();
    let of_order: Vec<TokenStream> =
        program.outputs.iter().map(|o| order.coefficient(o).unwrap_or(zero.clone())).collect();
    let missing = order.lanes.len().next_multiple_of(PACK) - order.lanes.len();
    if missing > 0 {
        let nothing = order.factor(zero);
        order.lanes.extend(core::iter::repeat_n([nothing; 2], missing));
    }
    let Order { factors, lanes, once, .. } = order;
    let (left, right): (Vec<_>, Vec<_>) = lanes.iter().map(|&[left, right]| (left, right)).unzip();
    let Variables { names, declarations, .. } = &variables;
    let (count, kinds, width, groups) = (names.len(), factors.len(), left.len(), component_groups(derived));
    let items = quote! {
        type Series = #private::Series<#ty, #count, #kinds, #width>;
        const GROUPS: &'static [::core::primitive::usize] = &[#(#groups),*];
        fn expand(
            &self,
            __t: Self::Scalar,
            __q: &Self::Configuration,
            __z: &Self::Speeds,
            __orders: ::core::primitive::usize,
            __series: &mut Self::Series,
        ) {
            let __zero = <#ty as #real>::zero();
            let __one = <#ty as #real>::one();
            #declarations
            #instructions
            #once
            __series.set_variables(0, [#(#names),*]);
            __series.set_variables(1, [#(#rates),*]);
            let mut __order = __zero;
            let mut __time = __one;
            for __k in 1..__orders {
                __order = __order + __one;
                let __over = #real::recip(__order);
                let __next = #real::recip(__order + __one);
                let __x = __series.variables(__k);
                let __sums = __series.convolution(__k, &[#([#left, #right]),*]);
                #line
                let __f = [#(#factors),*];
                __series.set_factors(__k, __f, [#(__f[#left]),*], [#(__f[#right]),*]);
                __series.set_variables(__k + 1, [#(#of_order * __next),*]);
                __time = __zero;
            }
        }
    };
    Some(derived.implementation(quote!(TaylorSystem), items))
}

/// Numbers of components of the configuration that are measured together, and each speed by itself.
fn component_groups(derived: &Derived<'_, '_>) -> Vec<usize> {
    let coordinates = &derived.subject.system.scene.coordinates;
    let group = |coordinate: &Coordinate<'_>| match coordinate {
        Coordinate::Pose(..) => vec![4, 3],
        Coordinate::Rotation(_) => vec![4],
        Coordinate::Plane { .. } => vec![2, 2],
        Coordinate::Scalar(_) => vec![],
    };
    let scalars = coordinates.iter().filter(|c| matches!(c, Coordinate::Scalar(_))).map(|_| 1);
    let mut groups: Vec<usize> = coordinates.iter().flat_map(group).chain(scalars).collect();
    groups.extend(derived.speeds().iter().map(|_| 1));
    groups
}
