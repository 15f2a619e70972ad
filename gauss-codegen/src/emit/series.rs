//! Power series in time: the recurrences of their coefficients, written out.
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
//! | θ = atan2(y, x), r = x² + y² | `(yₖx₀ − xₖy₀ + Σ (jyⱼxₖ₋ⱼ − jxⱼyₖ₋ⱼ − jθⱼrₖ₋ⱼ)/k)/r₀` |
//!
//! with sums over 0 < j < k (Knuth, TAOCP 2, 4.7). Each sum is a *lane* of the runtime's `Series`: all lanes of an order are summed
//! before its straight line begins. What is multiplied by constants or added costs one operation an order.

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::{BinaryFunction, Function, Map};
use crate::kernel::{Operand, Operation, Program};
use crate::mechanics::{ConfigurationKind, Coordinate, Method};

use super::kernel::{Derived, Subject};
use super::program::{Kept, ScalarTokens, in_blocks, operand, statements_kept};

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
    /// What is added up within the one instruction that reads it.
    inlined: Vec<bool>,
    /// Factors of order k of each lane.
    lanes: Vec<(TokenStream, TokenStream)>,
    /// What is computed once, after order 0.
    once: TokenStream,
}

fn indexed(prefix: &str, k: usize) -> Ident {
    format_ident!("__{}{}", prefix, k, span = Span::mixed_site())
}

impl<'g> Order<'_, 'g> {
    /// Order 0.
    fn first(&self, o: &Operand<'g>) -> TokenStream {
        operand(o, self.names, self.scalar)
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
        self.lanes.push((left, right));
        let lane = self.lanes.len() - 1;
        quote!(__sums[#lane])
    }

    /// The reciprocal of something of order 0, computed once.
    fn reciprocal(&mut self, k: usize, of: &TokenStream) -> TokenStream {
        let (name, real) = (indexed("r", k), &self.scalar.real);
        self.once.extend(quote!(let #name = #real::recip(#of);));
        quote!(#name)
    }

    /// What an instruction adds up, with what is added up for it alone.
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

    /// The statements of one instruction.
    fn statement(&mut self, k: usize, instruction: &Operation<'g>) -> TokenStream {
        let real = self.scalar.real.clone();
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
                sum.write(&real).unwrap_or(zero)
            }
            Operation::Divide(a, b) => {
                let divisor = self.first(b);
                let reciprocal = self.reciprocal(k, &divisor);
                let ak = self.coefficient(a).unwrap_or(zero);
                match self.coefficient(b) {
                    Some(bk) => {
                        let sum = self.lane(w.clone(), bk.clone());
                        quote!(#real::fma(-#v0, #bk, #ak - #sum) * #reciprocal)
                    }
                    None => quote!(#ak * #reciprocal),
                }
            }
            Operation::Call(Function::Sqrt, a) => {
                let reciprocal = self.reciprocal(k, &quote!((#v0 + #v0)));
                let (sum, ak) = (self.lane(w.clone(), w.clone()), self.coefficient(a).unwrap_or(zero));
                quote!((#ak - #sum) * #reciprocal)
            }
            Operation::Call(Function::Ln, a) => {
                let (a0, ak) = (self.first(a), self.coefficient(a).unwrap_or(zero));
                let reciprocal = self.reciprocal(k, &a0);
                let sum = self.lane(quote!(#w * __order), ak.clone());
                quote!(#real::fma(-__over, #sum, #ak) * #reciprocal)
            }
            Operation::Call(_, a) => {
                let ak = self.coefficient(a).unwrap_or(zero);
                let sum = self.lane(quote!(#ak * __order), w.clone());
                quote!(#real::fma(__over, #sum, #ak * #v0))
            }
            Operation::SineCosine(a) => {
                let ak = self.coefficient(a).unwrap_or(zero);
                let (s0, c0) = (self.first(&Operand::Sine(k)), self.first(&Operand::Cosine(k)));
                let (s, c) = (named("ws", k), named("wc", k));
                let (with_cosine, with_sine) =
                    (self.lane(quote!(#ak * __order), c.clone()), self.lane(quote!(#ak * __order), s.clone()));
                return quote! {
                    let #s = #real::fma(__over, #with_cosine, #ak * #c0);
                    let #c = -#real::fma(__over, #with_sine, #ak * #s0);
                };
            }
            Operation::Binary(BinaryFunction::Atan2, y, x) => {
                let (x0, y0) = (self.first(x), self.first(y));
                let (xk, yk) = (self.coefficient(x).unwrap_or(zero.clone()), self.coefficient(y).unwrap_or(zero));
                let (rk, square) = (named("wr", k), quote!((#x0 * #x0 + #y0 * #y0)));
                let reciprocal = self.reciprocal(k, &square);
                let squares = [self.lane(xk.clone(), xk.clone()), self.lane(yk.clone(), yk.clone())];
                let [x_squares, y_squares] = squares;
                let turned = [
                    self.lane(quote!(#yk * __order), xk.clone()),
                    self.lane(quote!(#xk * __order), yk.clone()),
                    self.lane(quote!(#w * __order), rk.clone()),
                ];
                let [forward, back, known] = turned;
                return quote! {
                    let #rk = #x_squares + #y_squares + ((#x0 + #x0) * #xk + (#y0 + #y0) * #yk);
                    let #w = #real::fma(__over, #forward - #back - #known, #yk * #x0 - #xk * #y0) * #reciprocal;
                };
            }
            Operation::Binary(..) => {
                let message = "bug in gauss-derive: a function without a power series";
                quote!(::core::compile_error!(#message))
            }
        };
        quote!(let #w = #value;)
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
    fn write(self, real: &TokenStream) -> Option<TokenStream> {
        let mut terms = self.terms.into_iter();
        let mut leaves: Vec<TokenStream> = Vec::new();
        let mut products = self.products.into_iter();
        while let Some((a, b)) = products.next() {
            let inner = match products.next() {
                Some((c, d)) => Some(match terms.next() {
                    Some(term) => quote!(#real::fma(#c, #d, #term)),
                    None => quote!(#c * #d),
                }),
                None => terms.next(),
            };
            leaves.push(match inner {
                Some(inner) => quote!(#real::fma(#a, #b, #inner)),
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

impl<'a, 'g> Derived<'a, 'g> {
    /// The implementation of `TaylorSystem`, where the series are derived.
    pub fn series(&'a self, bounded: &TokenStream, used: &TokenStream) -> Option<TokenStream> {
        if !self.has(Method::ComponentRates) {
            return None;
        }
        let (runtime, private, name) = (self.item().runtime, self.private(), self.kernel_name());
        let scalar = self.scalar();
        let (ty, real, zero) = (scalar.ty(), &scalar.real, quote!(__zero));
        let program = self.program(Method::ComponentRates);

        // Order 0: all components by name, the values of the program.
        let mut names: Map<u32, TokenStream> = self.constant_names();
        let mut coefficients: Map<u32, TokenStream> = Map::default();
        if let Some(time) = self.time() {
            names.insert(time.key(), quote!(t));
            coefficients.insert(time.key(), quote!(__time));
        }
        let mut arguments = self.configuration_arguments();
        arguments.push(self.vector_argument(quote!(z), self.speeds()));
        let (mut declarations, mut variables) = (TokenStream::new(), Vec::new());
        for argument in &arguments {
            let start = variables.len();
            for symbol in &argument.symbols {
                let (n, name) = (variables.len(), indexed("q", variables.len()));
                names.insert(symbol.key(), quote!(#name));
                coefficients.insert(symbol.key(), quote!(__x[#n]));
                variables.push(name);
            }
            let (own, array) = (&variables[start..], &argument.array);
            declarations.extend(quote!(let [#(#own),*] = #array;));
        }
        let (instructions, rates) = statements_kept(program, &names, &scalar, Kept::Everything);

        // Order k.
        let constant = |symbol: crate::algebra::Expr<'g>| !coefficients.contains_key(&symbol.key());
        let mut order = Order {
            program,
            names: &names,
            coefficients: &coefficients,
            scalar: &scalar,
            moving: program.moving(constant),
            inlined: program.added_once(),
            lanes: Vec::new(),
            once: TokenStream::new(),
        };
        let mut lines = Vec::new();
        for (k, instruction) in order.program.instructions.iter().enumerate() {
            if order.moving[k] && !order.inlined[k] {
                let names = match instruction {
                    Operation::SineCosine(_) => vec![named("ws", k), named("wc", k)],
                    Operation::Binary(..) => vec![named("wr", k), named("w", k)],
                    _ => vec![named("w", k)],
                };
                lines.push((names, order.statement(k, instruction)));
            }
        }
        let line = in_blocks(&lines);
        let of_order: Vec<TokenStream> =
            program.outputs.iter().map(|o| order.coefficient(o).unwrap_or(zero.clone())).collect();
        let Order { mut lanes, once, .. } = order;
        lanes.resize(lanes.len().next_multiple_of(PACK), (zero.clone(), zero.clone()));
        let (left, right): (Vec<_>, Vec<_>) = lanes.into_iter().unzip();
        let (count, width) = (variables.len(), left.len());
        let groups = self.component_groups();
        Some(quote! {
            #[automatically_derived]
            #[allow(unused_variables, clippy::all, clippy::pedantic)]
            impl #bounded #runtime::series::TaylorSystem for #name #used {
                type Series = #private::Series<#ty, #count, #width>;
                const GROUPS: &'static [::core::primitive::usize] = &[#(#groups),*];
                fn expand(
                    &self,
                    t: Self::Scalar,
                    q: &Self::Configuration,
                    z: &Self::Speeds,
                    order: ::core::primitive::usize,
                    series: &mut Self::Series,
                ) {
                    let __zero = <#ty as #real>::zero();
                    let __one = <#ty as #real>::one();
                    #declarations
                    #instructions
                    #once
                    series.set_variables(0, [#(#variables),*]);
                    series.set_variables(1, [#(#rates),*]);
                    let mut __order = __zero;
                    let mut __time = __one;
                    for __k in 1..order {
                        __order = __order + __one;
                        let __over = #real::recip(__order);
                        let __next = #real::recip(__order + __one);
                        let __x = series.variables(__k);
                        let __sums = series.convolution(__k);
                        #line
                        series.set_factors(__k, [#(#left),*], [#(#right),*]);
                        series.set_variables(__k + 1, [#(#of_order * __next),*]);
                        __time = __zero;
                    }
                }
            }
        })
    }

    /// How many components of the configuration are measured together, and each speed by itself.
    fn component_groups(&self) -> Vec<usize> {
        let mut groups = match self.subject {
            Subject::Body { scene, .. } => match scene.kinematics.kind {
                ConfigurationKind::Pose => vec![4, 3],
                ConfigurationKind::Rotation => vec![4],
                ConfigurationKind::PlanePose => vec![2, 2],
                ConfigurationKind::Coordinates => vec![1; scene.kinematics.configuration.len()],
            },
            Subject::System(subject) => {
                let coordinates = &subject.system.scene.coordinates;
                let group = |coordinate: &Coordinate<'g>| match coordinate {
                    Coordinate::Pose(..) => vec![4, 3],
                    Coordinate::Rotation(_) => vec![4],
                    Coordinate::Scalar(_) => vec![],
                };
                let scalars = coordinates.iter().filter(|c| matches!(c, Coordinate::Scalar(_))).map(|_| 1);
                coordinates.iter().flat_map(group).chain(scalars).collect()
            }
        };
        groups.extend(self.speeds().iter().map(|_| 1));
        groups
    }
}
