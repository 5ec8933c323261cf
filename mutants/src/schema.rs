//! The schema: a source text with every mutant in it, each behind a switch.
//!
//! Where a mutant changes an expression, that expression becomes `if is(7) { mutated } else { original }`. Only one mutant
//! is ever on, so the mutated branches hold the plain source; only the last branch goes on nesting. The text thus grows
//! with the sum of the expressions, not exponentially.

use crate::list::{Genre, Mutant, Place, Span};
use proc_macro2::LineColumn;
use std::collections::BTreeMap;
use std::ops::Range;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// Bytes of a text that belong to a mutant, to find whose code does not compile.
pub type Owned = (Range<usize>, usize);

/// The text with its mutants.
pub struct Schema {
    pub text: String,
    pub owned: Vec<Owned>,
    /// Expressions with all their mutants: where types disagree, the compiler may point at neither branch.
    pub choices: Vec<Owned>,
    /// Mutants with no place in a schema.
    pub left_out: Vec<usize>,
}

/// A place in the source where mutants go.
enum Edit {
    /// The expression in this range, or for each mutant another one.
    Choice(Range<usize>, Vec<(usize, String)>),
    /// Text put in front of what is at the end of the empty range.
    Insert(usize, Vec<(usize, String)>),
}

impl Edit {
    fn range(&self) -> Range<usize> {
        match self {
            Self::Choice(range, _) => range.clone(),
            Self::Insert(at, _) => *at..*at,
        }
    }
}

/// Puts `mutants`, each with its number, all of one file, into its `source`.
pub fn schema(source: &str, mutants: &[(usize, &Mutant)]) -> syn::Result<Schema> {
    let file = syn::parse_file(source)?;
    let lines = Lines::of_text(source);
    let mut finder = Finder {
        lines: &lines,
        expressions: BTreeMap::new(),
        guards: BTreeMap::new(),
        bodies: BTreeMap::new(),
    };
    finder.visit_file(&file);
    let mut choices: BTreeMap<(usize, usize), Vec<(usize, String)>> = BTreeMap::new();
    let mut inserts: BTreeMap<usize, Vec<(usize, String)>> = BTreeMap::new();
    let mut left_out = Vec::new();
    for (number, mutant) in mutants {
        let at = lines.range(mutant.span);
        let switch = format!("crate::mutants_switch::is({number})");
        match mutant.genre {
            // `impl Trait` stands for one type, which the replacement has not.
            Genre::FnValue if mutant.change().contains(" -> impl ") => left_out.push(*number),
            Genre::FnValue => match finder.bodies.get(&at.start) {
                Some(body) => inserts
                    .entry(*body)
                    .or_default()
                    .push((*number, format!("if {switch} {{ return {}; }} ", mutant.replacement))),
                None => left_out.push(*number),
            },
            Genre::MatchArm => match finder.guards.get(&(at.start, at.end)) {
                Some(Guard::None(end)) => inserts
                    .entry(*end)
                    .or_default()
                    .push((*number, format!(" if !{switch}"))),
                Some(Guard::Some(range)) => choices
                    .entry((range.start, range.end))
                    .or_default()
                    .push((*number, "false".to_owned())),
                None => left_out.push(*number),
            },
            Genre::MatchArmGuard => choices
                .entry((at.start, at.end))
                .or_default()
                .push((*number, mutant.replacement.clone())),
            Genre::BinaryOperator | Genre::UnaryOperator | Genre::StructField => {
                match finder.expressions.get(&(at.start, at.end)) {
                    Some(whole) => {
                        let (before, after) = (&source[whole.start..at.start], &source[at.end..whole.end]);
                        // A field that goes takes its comma with it.
                        let after = match mutant.genre {
                            Genre::StructField => after.trim_start().trim_start_matches(','),
                            _ => after,
                        };
                        let mutated = format!("{before}{}{after}", mutant.replacement);
                        choices
                            .entry((whole.start, whole.end))
                            .or_default()
                            .push((*number, mutated));
                    }
                    None => left_out.push(*number),
                }
            }
        }
    }
    let mut edits: Vec<Edit> = choices
        .into_iter()
        .map(|((start, end), mutants)| Edit::Choice(start..end, mutants))
        .chain(inserts.into_iter().map(|(at, mutants)| Edit::Insert(at, mutants)))
        .collect();
    // Outer before inner, and what is put in front of an expression before it.
    edits.sort_by_key(|edit| {
        let range = edit.range();
        (range.start, !range.is_empty(), std::cmp::Reverse(range.end))
    });
    let mut writer = Writer {
        source,
        text: String::with_capacity(4 * source.len()),
        owned: Vec::new(),
        choices: Vec::new(),
    };
    writer.range(0..source.len(), &edits);
    Ok(Schema {
        text: writer.text,
        owned: writer.owned,
        choices: writer.choices,
        left_out,
    })
}

struct Writer<'a> {
    source: &'a str,
    text: String,
    owned: Vec<Owned>,
    choices: Vec<Owned>,
}

impl Writer<'_> {
    /// Writes a range of the source with the edits in it.
    fn range(&mut self, range: Range<usize>, edits: &[Edit]) {
        let (mut at, mut k) = (range.start, 0);
        while let Some(edit) = edits.get(k) {
            let here = edit.range();
            self.text.push_str(&self.source[at..here.start]);
            at = here.end;
            k += 1;
            match edit {
                Edit::Insert(_, mutants) => {
                    for (number, text) in mutants {
                        self.owned(*number, text);
                    }
                }
                Edit::Choice(_, mutants) => {
                    let inner = edits[k..]
                        .iter()
                        .take_while(|edit| edit.range().start < here.end)
                        .count();
                    let start = self.text.len();
                    self.text.push('(');
                    for (number, text) in mutants {
                        self.owned(*number, &format!("if crate::mutants_switch::is({number}) {{ {text} }}"));
                        self.text.push_str(" else ");
                    }
                    self.text.push_str("{ ");
                    self.range(here.clone(), &edits[k..k + inner]);
                    self.text.push_str(" })");
                    let whole = start..self.text.len();
                    // Inner before outer.
                    self.choices
                        .extend(mutants.iter().map(|(number, _)| (whole.clone(), *number)));
                    k += inner;
                }
            }
        }
        self.text.push_str(&self.source[at..range.end]);
    }

    fn owned(&mut self, number: usize, text: &str) {
        let start = self.text.len();
        self.text.push_str(text);
        self.owned.push((start..self.text.len(), number));
    }
}

/// The condition of a match arm.
enum Guard {
    /// None: one may be put here.
    None(usize),
    Some(Range<usize>),
}

/// Finds the expressions, arms and bodies that mutants may be in.
struct Finder<'a> {
    lines: &'a Lines<'a>,
    /// By the range of its operator or field, the expression.
    expressions: BTreeMap<(usize, usize), Range<usize>>,
    /// By the range of an arm, its condition.
    guards: BTreeMap<(usize, usize), Guard>,
    /// By the start of a body's first statement, or of its braces, where its first statement goes.
    bodies: BTreeMap<usize, usize>,
}

impl Finder<'_> {
    fn body(&mut self, block: &syn::Block) {
        let inside = self.lines.of(block.brace_token.span.open()).end;
        self.bodies
            .insert(self.lines.of(block.brace_token.span.open()).start, inside);
        if let Some(first) = block.stmts.first() {
            self.bodies.insert(self.lines.of(first.span()).start, inside);
        }
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_expr(&mut self, node: &'ast syn::Expr) {
        let whole = self.lines.of(node.span());
        let mut file = |part: proc_macro2::Span| {
            let part = self.lines.of(part);
            self.expressions.insert((part.start, part.end), whole.clone());
        };
        match node {
            syn::Expr::Binary(binary) => file(binary.op.span()),
            syn::Expr::Unary(unary) => file(unary.op.span()),
            syn::Expr::Struct(literal) => literal.fields.iter().for_each(|field| file(field.span())),
            _ => {}
        }
        visit::visit_expr(self, node);
    }

    // A constant is computed by the compiler, before any switch is set.
    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}

    fn visit_arm(&mut self, node: &'ast syn::Arm) {
        let whole = self.lines.of(node.span());
        let guard = match &node.guard {
            Some((_, guard)) => Guard::Some(self.lines.of(guard.span())),
            None => Guard::None(self.lines.of(node.pat.span()).end),
        };
        self.guards.insert((whole.start, whole.end), guard);
        visit::visit_arm(self, node);
    }

    fn visit_item_fn(&mut self, node: &'ast syn::ItemFn) {
        self.body(&node.block);
        visit::visit_item_fn(self, node);
    }

    fn visit_impl_item_fn(&mut self, node: &'ast syn::ImplItemFn) {
        self.body(&node.block);
        visit::visit_impl_item_fn(self, node);
    }

    fn visit_trait_item_fn(&mut self, node: &'ast syn::TraitItemFn) {
        if let Some(block) = &node.default {
            self.body(block);
        }
        visit::visit_trait_item_fn(self, node);
    }
}

/// From lines and columns to bytes.
struct Lines<'a>(Vec<(usize, &'a str)>);

impl<'a> Lines<'a> {
    fn of_text(source: &'a str) -> Self {
        let mut at = 0;
        Self(
            source
                .split_inclusive('\n')
                .map(|line| {
                    at += line.len();
                    (at - line.len(), line)
                })
                .collect(),
        )
    }

    /// The byte at a line from 1 and a column from 0.
    fn byte(&self, line: usize, column: usize) -> usize {
        let (start, text) = self.0[line - 1];
        start + text.char_indices().nth(column).map_or(text.len(), |(byte, _)| byte)
    }

    fn of(&self, span: proc_macro2::Span) -> Range<usize> {
        let byte = |at: LineColumn| self.byte(at.line, at.column);
        byte(span.start())..byte(span.end())
    }

    fn range(&self, span: Span) -> Range<usize> {
        let byte = |at: Place| self.byte(at.line, at.column - 1);
        byte(span.start)..byte(span.end)
    }
}
