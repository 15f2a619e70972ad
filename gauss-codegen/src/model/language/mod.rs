//! From the tokens of attributes to clauses, each read on its own, with every mistake at its token.

pub mod actions;
pub mod arguments;
pub mod arithmetic;
pub mod attributes;
pub mod chains;
pub mod contacts;
pub mod context;
pub mod declarations;
pub mod fields;
pub mod functions;
pub mod ground;
pub mod kind;
pub mod modes;
pub mod nesting;
pub mod own_functions;
pub mod placements;
pub mod robots;
pub mod role_clauses;
pub mod role_words;
pub mod self_contact;
pub mod shapes;
pub mod statements;
pub mod struct_clauses;
pub mod synonyms;
pub mod units;
pub mod words;
