//! Operations and the longest chain of each method, read from the generated code.

use std::collections::HashMap;

use proc_macro2::{TokenStream, TokenTree};
use syn::{Block, Expr, ImplItem, Item, Local, Macro, Pat, Stmt};

/// What one evaluation of a method costs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// Additions, multiplications, divisions, roots, transcendental functions.
    pub operations: [u32; 5],
    /// Cycles from the arguments to the last result, were there no limit to what runs at once.
    pub chain: u32,
}

/// Methods whose costs are pinned; what else `OPERATIONS` has serves checks.
const PINNED: [&str; 28] = [
    "acceleration",
    "momentum",
    "velocity",
    "momentum_rate",
    "kinetic_energy",
    "potential_energy",
    "kinematics",
    "configuration_rates",
    "evaluate",
    "multipliers",
    "linearize",
    "by_parameters",
    "linearize_inverse",
    "hessian",
    "regressor",
    "frames",
    "centroidal_momentum",
    "centroidal_matrix",
    "centroidal_bias",
    "nonlinear_effects",
    "gravity_torques",
    "gaps",
    "contact_rates",
    "contact_jacobian",
    "friction",
    "impulse_response",
    "impulse_dynamics",
    "impulse_velocities",
];

/// Of `kernel()`, which runs once.
pub const KERNEL: &str = "kernel";

/// The number of tokens of the generated code, which rustc has to read.
pub const TOKENS: &str = "tokens";

/// Rows of all methods that cost something.
///
/// # Errors
/// When the code is not Rust.
pub fn of_code(code: TokenStream) -> syn::Result<Vec<(String, Row)>> {
    let tokens = count(code.clone());
    let file: syn::File = syn::parse2(code)?;
    let mut counts = Vec::new();
    let mut chains = HashMap::new();
    for item in &file.items {
        read(item, &mut counts, &mut chains);
    }
    let mut rows: Vec<(String, Row)> = counts
        .into_iter()
        .filter(|(method, operations)| (PINNED.contains(&method.as_str()) || method == KERNEL) && *operations != [0; 5])
        .map(|(method, operations)| {
            let chain = chains.get(&method).copied().unwrap_or(0);
            (method, Row { operations, chain })
        })
        .collect();
    rows.push((TOKENS.into(), Row { operations: [tokens, 0, 0, 0, 0], chain: 0 }));
    Ok(rows)
}

fn count(tokens: TokenStream) -> u32 {
    let of = |token: TokenTree| match token {
        TokenTree::Group(group) => 2 + count(group.stream()),
        _ => 1,
    };
    tokens.into_iter().map(of).sum()
}

/// Constants with counts, and functions of the same names.
fn read(item: &Item, counts: &mut Vec<(String, [u32; 5])>, chains: &mut HashMap<String, u32>) {
    match item {
        Item::Const(constant) => {
            if let Expr::Block(block) = &*constant.expr {
                let items = block.block.stmts.iter().filter_map(|statement| match statement {
                    Stmt::Item(item) => Some(item),
                    _ => None,
                });
                items.for_each(|item| read(item, counts, chains));
            }
        }
        Item::Impl(item) => {
            for member in &item.items {
                match member {
                    ImplItem::Const(constant) => constants(&constant.ident.to_string(), &constant.expr, counts),
                    ImplItem::Fn(function) if item.trait_.is_some() => {
                        let chain = Chain::default().block(&function.block);
                        chains.insert(function.sig.ident.to_string(), chain);
                    }
                    _ => {}
                }
            }
        }
        _ => {}
    }
}

/// `OperationCount::new(…)` under the name of the constant, or of the field that it is assigned to in a block.
fn constants(name: &str, value: &Expr, counts: &mut Vec<(String, [u32; 5])>) {
    match value {
        Expr::Block(block) => {
            for statement in &block.block.stmts {
                if let Stmt::Expr(Expr::Assign(assignment), _) = statement
                    && let Expr::Field(syn::ExprField { member: syn::Member::Named(name), .. }) = &*assignment.left
                {
                    constants(&name.to_string(), &assignment.right, counts);
                }
            }
        }
        Expr::Call(call) if path(&call.func).is_some_and(|path| path.ends_with("OperationCount::new")) => {
            let numbers = call.args.iter().map(|argument| match argument {
                Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(number), .. }) => number.base10_parse::<u32>().ok(),
                _ => None,
            });
            let numbers: Option<Vec<u32>> = numbers.collect();
            if let Some(operations) = numbers.and_then(|numbers| numbers.try_into().ok()) {
                counts.push((name.into(), operations));
            }
        }
        _ => {}
    }
}

fn path(expression: &Expr) -> Option<String> {
    let Expr::Path(path) = expression else { return None };
    let names: Vec<String> = path.path.segments.iter().map(|segment| segment.ident.to_string()).collect();
    Some(names.join("::"))
}

/// When each name has its value. Cycles as in `Program::cost` (Fog, Instruction tables).
#[derive(Default)]
struct Chain {
    ready: HashMap<String, u32>,
}

impl Chain {
    fn block(&mut self, block: &Block) -> u32 {
        let mut last = 0;
        for statement in &block.stmts {
            match statement {
                Stmt::Local(Local { pat, init: Some(init), .. }) => {
                    let ready = self.of(&init.expr);
                    self.bind(pat, ready);
                }
                Stmt::Expr(expression, _) => last = self.of(expression),
                _ => {}
            }
        }
        last
    }

    fn bind(&mut self, pattern: &Pat, ready: u32) {
        match pattern {
            Pat::Ident(name) => {
                self.ready.insert(name.ident.to_string(), ready);
            }
            Pat::Tuple(parts) => parts.elems.iter().for_each(|part| self.bind(part, ready)),
            Pat::Slice(parts) => parts.elems.iter().for_each(|part| self.bind(part, ready)),
            Pat::Type(typed) => self.bind(&typed.pat, ready),
            _ => {}
        }
    }

    /// `with_vectors! { {…} {…} }`, of which the second does number by number what the first does in packs.
    fn without_vectors(&mut self, called: &Macro) -> u32 {
        let blocks = called.tokens.clone().into_iter().map(|group| syn::parse2::<Block>(group.into()));
        match blocks.collect::<Result<Vec<Block>, _>>().as_deref() {
            Ok([_, single]) => self.block(single),
            _ => panic!("a macro that is not known: {}", called.tokens),
        }
    }

    /// What has been declared before.
    fn assign(&mut self, names: &Expr, ready: u32) {
        match names {
            Expr::Path(_) => self.ready.extend(path(names).map(|name| (name, ready))),
            Expr::Tuple(parts) => parts.elems.iter().for_each(|part| self.assign(part, ready)),
            Expr::Array(parts) => parts.elems.iter().for_each(|part| self.assign(part, ready)),
            _ => {}
        }
    }

    fn of(&mut self, expression: &Expr) -> u32 {
        match expression {
            Expr::Assign(assignment) => {
                let ready = self.of(&assignment.right);
                self.assign(&assignment.left, ready);
                ready
            }
            Expr::Path(_) => path(expression).and_then(|name| self.ready.get(&name).copied()).unwrap_or(0),
            Expr::Binary(binary) => {
                let own = if matches!(binary.op, syn::BinOp::Div(_)) { 15 } else { 4 };
                own + self.of(&binary.left).max(self.of(&binary.right))
            }
            Expr::Unary(unary) => u32::from(matches!(unary.op, syn::UnOp::Neg(_))) + self.of(&unary.expr),
            Expr::Call(call) => {
                let name = path(&call.func).unwrap_or_default();
                let cycles = cycles(&name);
                let argument = |argument: &Expr, chain: &mut Self| match argument {
                    // The negation of a product is part of the instruction that adds it.
                    Expr::Unary(unary) if function(&name) == Some("fma") => chain.of(&unary.expr),
                    other => chain.of(other),
                };
                cycles + call.args.iter().map(|a| argument(a, self)).max().unwrap_or(0)
            }
            Expr::MethodCall(call) => {
                let arguments = call.args.iter().map(|argument| self.of(argument)).max().unwrap_or(0);
                arguments.max(self.of(&call.receiver))
            }
            Expr::Block(block) => self.block(&block.block),
            Expr::Macro(called) => self.without_vectors(&called.mac),
            Expr::Array(array) => array.elems.iter().map(|e| self.of(e)).max().unwrap_or(0),
            Expr::Tuple(tuple) => tuple.elems.iter().map(|e| self.of(e)).max().unwrap_or(0),
            Expr::Struct(value) => value.fields.iter().map(|field| self.of(&field.expr)).max().unwrap_or(0),
            Expr::Paren(inner) => self.of(&inner.expr),
            Expr::Group(inner) => self.of(&inner.expr),
            Expr::Reference(inner) => self.of(&inner.expr),
            _ => 0,
        }
    }
}

/// The function of the scalar that is called by that path: one of its trait, or a product and a sum of a type that is
/// known.
fn function(path: &str) -> Option<&str> {
    let known = || ["fma_f64", "fma_f32"].iter().any(|name| path.ends_with(name)).then_some("fma");
    path.rsplit_once("Real::").map(|(_, function)| function).or_else(known)
}

/// Of a function of the scalar; all others only hand on.
fn cycles(name: &str) -> u32 {
    let Some(function) = function(name) else { return 0 };
    match function {
        "fma" | "abs" | "signum" | "min" | "max" => 4,
        "sqrt" => 15,
        "sin_cos" => 40,
        "zero" | "one" | "ratio" => 0,
        _ => 60,
    }
}
