//! The modules of a crate, and where each name in them is defined.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use quote::ToTokens;
use syn::{Attribute, Item, UseTree, Visibility};

/// Names from the root of the crate.
pub type ModulePath = Vec<String>;

/// What a name in a module stands for.
enum Meaning {
    Defined,
    Module,
    /// The path as it is written.
    Imported(Vec<String>),
}

pub struct Module {
    pub file: String,
    pub items: Vec<Item>,
    names: BTreeMap<String, Vec<Meaning>>,
    /// What `use …::*` names.
    globs: Vec<Vec<String>>,
}

/// A private `use`: the path, without the name that it may get.
pub struct Import {
    pub path: Vec<String>,
}

pub struct Modules(BTreeMap<ModulePath, Module>);

fn below(path: &[String], name: &str) -> ModulePath {
    path.iter().map(String::as_str).chain([name]).map(str::to_owned).collect()
}

/// Attributes of what is compiled for tests alone.
fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().filter(|attribute| attribute.path().is_ident("cfg")).any(|attribute| {
        let condition = attribute.meta.to_token_stream().to_string();
        condition.starts_with("cfg (test") || condition.starts_with("cfg (all (test")
    })
}

/// `#[path = "…"]`.
fn written_path(attributes: &[Attribute]) -> Option<String> {
    let written = attributes.iter().find(|attribute| attribute.path().is_ident("path"))?;
    let syn::Expr::Lit(literal) = &written.meta.require_name_value().ok()?.value else { return None };
    match &literal.lit {
        syn::Lit::Str(path) => Some(path.value()),
        _ => None,
    }
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

fn defined(item: &Item) -> Option<String> {
    let ident = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Macro(item) => item.ident.as_ref()?,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::Type(item) => &item.ident,
        _ => return None,
    };
    Some(ident.to_string())
}

/// The leaves of a `use`: path, and the name that it is known by; `*` for all.
pub fn leaves(tree: &UseTree, before: &[String], found: &mut Vec<(Vec<String>, String)>) {
    let with = |name: String| [before, &[name]].concat();
    match tree {
        UseTree::Path(path) => leaves(&path.tree, &with(path.ident.to_string()), found),
        UseTree::Name(name) if name.ident == "self" => {
            found.push((before.to_vec(), before.last().cloned().unwrap_or_default()));
        }
        UseTree::Name(name) => found.push((with(name.ident.to_string()), name.ident.to_string())),
        UseTree::Rename(name) => found.push((with(name.ident.to_string()), name.rename.to_string())),
        UseTree::Glob(_) => found.push((before.to_vec(), "*".into())),
        UseTree::Group(group) => group.items.iter().for_each(|tree| leaves(tree, before, found)),
    }
}

impl Modules {
    /// All modules of the crate with this root (`lib.rs`, `main.rs`), but those of tests.
    pub fn of(root: &Path) -> Self {
        let mut modules = Self(BTreeMap::new());
        let parts = root.parent().zip(root.file_name());
        let (folder, name) = parts.unwrap_or_else(|| panic!("{} is no file", root.display()));
        modules.read(folder, Path::new(name), &[]);
        modules
    }

    fn read(&mut self, source: &Path, file: &Path, path: &[String]) {
        let name = file.display().to_string();
        let text = fs::read_to_string(source.join(file)).unwrap_or_else(|error| panic!("{name}: {error}"));
        let parsed = syn::parse_file(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        // Where its modules are.
        let own = ["lib.rs", "main.rs", "mod.rs"].iter().any(|own| file.ends_with(own));
        let folder = if own { file.with_file_name("") } else { file.with_extension("") };
        self.add(source, &name, path, &folder, parsed.items);
    }

    fn add(&mut self, source: &Path, file: &str, path: &[String], folder: &Path, items: Vec<Item>) {
        let mut module = Module { file: file.to_owned(), items: Vec::new(), names: BTreeMap::new(), globs: Vec::new() };
        for item in items {
            if is_test(attributes(&item)) {
                continue;
            }
            match item {
                Item::Mod(inner) => {
                    let name = inner.ident.to_string();
                    module.names.entry(name.clone()).or_default().push(Meaning::Module);
                    let (path, folder) = (below(path, &name), folder.join(&name));
                    match inner.content {
                        Some((_, items)) => self.add(source, file, &path, &folder, items),
                        None => {
                            let written = written_path(&inner.attrs).map(|path| Path::new(file).with_file_name(path));
                            let (inside, beside) = (folder.join("mod.rs"), folder.with_extension("rs"));
                            let found = if source.join(&inside).exists() { inside } else { beside };
                            self.read(source, &written.unwrap_or(found), &path);
                        }
                    }
                }
                item => module.take(item),
            }
        }
        self.0.insert(path.to_vec(), module);
    }

    pub fn iter(&self) -> impl Iterator<Item = (&ModulePath, &Module)> {
        self.0.iter()
    }

    /// The files that define what a path in a module means: several where a module and a function share a name.
    pub fn files(&self, from: &[String], path: &[String]) -> BTreeSet<String> {
        let mut files = BTreeSet::new();
        self.follow(from, path, &mut BTreeSet::new(), &mut |file| {
            files.insert(file.to_owned());
        });
        files
    }

    fn follow(
        &self,
        from: &[String],
        path: &[String],
        seen: &mut BTreeSet<(ModulePath, Vec<String>)>,
        found: &mut dyn FnMut(&str),
    ) {
        let Some((first, rest)) = path.split_first() else { return };
        if !seen.insert((from.to_vec(), path.to_vec())) {
            return;
        }
        match first.as_str() {
            "crate" | "$crate" => return self.follow(&[], rest, seen, found),
            "self" => return self.follow(from, rest, seen, found),
            "super" => return self.follow(&from[..from.len().saturating_sub(1)], rest, seen, found),
            _ => {}
        }
        let Some(module) = self.0.get(from) else { return };
        for meaning in module.names.get(first).into_iter().flatten() {
            match meaning {
                Meaning::Defined => found(&module.file),
                Meaning::Module => self.follow(&below(from, first), rest, seen, found),
                // `use parse::parse` means the module by the first word of its path, not itself.
                Meaning::Imported(target) if target.first() == Some(first) => {
                    self.follow(&below(from, first), &[&target[1..], rest].concat(), seen, found);
                }
                Meaning::Imported(target) => self.follow(from, &[target, rest].concat(), seen, found),
            }
        }
        if !module.names.contains_key(first) {
            // What other crates hand out is not defined here.
            let is_here = |glob: &&Vec<String>| match glob[0].as_str() {
                "crate" | "$crate" | "self" | "super" => true,
                first => module.names.contains_key(first),
            };
            for glob in module.globs.iter().filter(is_here) {
                self.follow(from, &[glob, path].concat(), seen, found);
            }
        }
    }
}

impl Module {
    fn take(&mut self, item: Item) {
        if let Item::Use(item) = &item {
            let mut found = Vec::new();
            leaves(&item.tree, &[], &mut found);
            for (path, name) in found {
                if name == "*" {
                    self.globs.push(path);
                } else if path != [name.clone()] {
                    self.names.entry(name).or_default().push(Meaning::Imported(path));
                }
            }
        }
        if let Some(name) = defined(&item) {
            self.names.entry(name).or_default().push(Meaning::Defined);
        }
        self.items.push(item);
    }

    /// What private `use` declarations name: those with a visibility hand on.
    pub fn imports(&self) -> Vec<Import> {
        let private = self.items.iter().filter_map(|item| match item {
            Item::Use(item) if matches!(item.vis, Visibility::Inherited) => Some(&item.tree),
            _ => None,
        });
        let mut found = Vec::new();
        private.for_each(|tree| leaves(tree, &[], &mut found));
        found.into_iter().filter(|(_, name)| name != "*").map(|(path, _)| Import { path }).collect()
    }
}
