//! Changes of a tree of tokens.

use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

use super::random::Random;

/// A token, or what stands in brackets.
#[derive(Clone)]
pub enum Tree {
    Token(TokenTree),
    Group(Delimiter, Vec<Tree>),
}

impl Tree {
    pub fn all(tokens: TokenStream) -> Vec<Tree> {
        let tree = |token| match token {
            TokenTree::Group(group) => Tree::Group(group.delimiter(), Tree::all(group.stream())),
            other => Tree::Token(other),
        };
        tokens.into_iter().map(tree).collect()
    }

    pub fn tokens(trees: &[Tree]) -> TokenStream {
        let token = |tree: &Tree| match tree {
            Tree::Token(token) => token.clone(),
            Tree::Group(delimiter, inner) => Group::new(*delimiter, Tree::tokens(inner)).into(),
        };
        trees.iter().map(token).collect()
    }

    #[allow(dead_code, reason = "the fuzz target has no need of it")]
    pub fn count(trees: &[Tree]) -> usize {
        let count = |tree: &Tree| match tree {
            Tree::Token(_) => 1,
            Tree::Group(_, inner) => 1 + Tree::count(inner),
        };
        trees.iter().map(count).sum()
    }
}

/// Words of the language and of Rust.
const WORDS: &str = "m x y t a g v w k theta body position rotation velocity mass inertia center_of_mass added_mass gravity force \
    torque wrench drag spring stop damping drive potential constraint independent coordinates speeds kinematics frame particle \
    point define input medium central_gravity limit linearize taylor regressor chart motion jet hybrid left_invariant \
    right_invariant free planar fixed_point euler_zyx rodrigues Pose Rotation Vector3 parent at along value axes observer \
    stiffness length least most width sin cos tan exp ln sqrt powi atan2 dot cross rotation_x rotation_y rotation_z inverse twist \
    rate abs min max hypot signum clamp smooth_step unit crate f64 f32 RigidBody Matrix3 Matrix6 _ self if match as return";

const NUMBERS: &str = "0 1 2 3 7 100 101 1000 0.0 0.1 1e308 1e-308 1e309 1e-400 99999999999999999999 1.5707963267948966 1u8 0x10 \
    2.5f32 1e5 12345678901234567890.123456789";

const SIGNS: &str = "+-*/=.,:;<>&|!?#^%@~$'";

/// Some changes, one after the other; `other` gives parts to be put in.
pub fn mutated(mut trees: Vec<Tree>, other: &[Tree], random: &mut Random) -> Vec<Tree> {
    for _ in 0..1 + random.below(5) {
        change(&mut trees, other, random);
    }
    trees
}

/// One change somewhere: the deeper, the likelier.
fn change(trees: &mut Vec<Tree>, other: &[Tree], random: &mut Random) {
    let groups: Vec<usize> = (0..trees.len()).filter(|&k| matches!(trees[k], Tree::Group(..))).collect();
    if !groups.is_empty()
        && random.below(8) > 0
        && let Tree::Group(_, inner) = &mut trees[*random.of(&groups)]
    {
        return change(inner, other, random);
    }
    if trees.is_empty() {
        return trees.push(token(random));
    }
    let (k, j) = (random.below(trees.len()), random.below(trees.len()));
    match random.below(14) {
        0 => _ = trees.remove(k),
        1 => trees.insert(k, trees[j].clone()),
        2 => trees.swap(k, j),
        3 | 4 => trees[k] = token(random),
        5 => trees.insert(k, token(random)),
        6 => trees[k] = part(other, random),
        7 => trees.insert(k, part(other, random)),
        8 => trees[k] = Tree::Group(delimiter(random), vec![trees[k].clone()]),
        9 => {
            if let Tree::Group(_, inner) = &trees[k] {
                let inner = inner.clone();
                trees.splice(k..=k, inner);
            }
        }
        10 => {
            let (from, to) = (k.min(j), k.max(j));
            let copy = trees[from..=to].to_vec();
            let most = *random.of(&[2, 5, 40]);
            let times = 1 + random.below(most);
            (0..times).for_each(|_| _ = trees.splice(to + 1..to + 1, copy.clone()));
        }
        11 => nest(&mut trees[k], random),
        12 => _ = trees.drain(k.min(j)..k.max(j)),
        _ => {
            // A definition of the part, or an operation on it.
            let sign = Tree::Token(Punct::new(*random.of(&['+', '-', '*', '/']), Spacing::Alone).into());
            let operand = if random.below(2) == 0 { token(random) } else { trees[j].clone() };
            trees.splice(k + 1..k + 1, [sign, operand]);
        }
    }
}

/// A part of another scene, or all of it that is in brackets.
fn part(trees: &[Tree], random: &mut Random) -> Tree {
    match trees.get(random.below(trees.len().max(1))) {
        Some(Tree::Group(_, inner)) if random.below(4) > 0 => part(inner, random),
        Some(tree) => tree.clone(),
        None => token(random),
    }
}

/// f(f(f(…))).
fn nest(tree: &mut Tree, random: &mut Random) {
    let function = *random.of(&["sin", "exp", "sqrt", "abs", "", "-", "rotation_x", "inverse", "powi"]);
    for _ in 0..*random.of(&[1, 2, 10, 100, 200]) {
        let mut inner = vec![tree.clone()];
        match function {
            "powi" => inner.extend([punct(','), Tree::Token(Literal::u32_unsuffixed(2).into())]),
            "-" => inner.insert(0, punct('-')),
            _ => {}
        }
        let group = Tree::Group(Delimiter::Parenthesis, inner);
        let word = (!matches!(function, "" | "-")).then(|| Tree::Token(word(function)));
        // A token tree of its own, so that it stays one part: the invisible brackets of a macro's fragment.
        *tree = Tree::Group(Delimiter::None, word.into_iter().chain([group]).collect());
    }
}

fn punct(sign: char) -> Tree {
    Tree::Token(Punct::new(sign, Spacing::Alone).into())
}

fn word(word: &str) -> TokenTree {
    Ident::new(word, Span::call_site()).into()
}

fn delimiter(random: &mut Random) -> Delimiter {
    *random.of(&[Delimiter::Parenthesis, Delimiter::Bracket, Delimiter::Brace, Delimiter::None])
}

fn token(random: &mut Random) -> Tree {
    let words: Vec<&str> = WORDS.split_whitespace().collect();
    let numbers: Vec<&str> = NUMBERS.split_whitespace().collect();
    let signs: Vec<char> = SIGNS.chars().filter(|sign| *sign != '\'').collect();
    Tree::Token(match random.below(8) {
        0..=3 => word(random.of::<&str>(&words)),
        4 | 5 => random.of::<&str>(&numbers).parse::<Literal>().expect("numbers are literals").into(),
        6 => Literal::string(random.of::<&str>(&words)).into(),
        _ => Punct::new(*random.of(&signs), if random.below(2) == 0 { Spacing::Alone } else { Spacing::Joint }).into(),
    })
}
