//! Places where a mistake can be made, read from the syntax.

use quote::ToTokens;
use std::ops::Range;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, ReturnType, Type, UnOp};

/// One mistake in one place of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    /// Line, from 1.
    pub line: usize,
    /// The function it is in, with its type.
    pub function: String,
    /// What is replaced, as bytes of the file. Empty for what a function begins with.
    pub range: Range<usize>,
    /// What stands there instead, or is returned at once.
    pub instead: String,
    /// The change in words.
    pub change: String,
    /// Whether `instead` is returned instead of the function's value.
    pub returns: bool,
}

/// All mistakes of a file, in its order. Constants, tests and what macros write are left out: a choice at run time
/// cannot be made there, or the syntax is not known.
///
/// # Errors
/// If the file is not Rust.
pub fn of(text: &str) -> syn::Result<Vec<Point>> {
    let file = syn::parse_file(text)?;
    let mut finder = Finder { text, names: Vec::new(), inside: false, points: Vec::new() };
    finder.visit_file(&file);
    Ok(finder.points)
}

struct Finder<'a> {
    text: &'a str,
    names: Vec<String>,
    /// Within the body of a function that is called at run time.
    inside: bool,
    points: Vec<Point>,
}

impl Finder<'_> {
    fn text(&self, of: &impl Spanned) -> &str {
        &self.text[of.span().byte_range()]
    }

    fn push(&mut self, of: &impl Spanned, instead: String, change: String) {
        if !self.inside {
            return;
        }
        let (range, line) = (of.span().byte_range(), of.span().start().line);
        let function = self.names.join("::");
        self.points.push(Point { line, function, range, instead, change, returns: false });
    }

    fn function(&mut self, signature: &syn::Signature, attributes: &[syn::Attribute], block: &syn::Block) {
        if is_test(attributes) || signature.constness.is_some() {
            return;
        }
        self.names.push(signature.ident.to_string());
        let before = std::mem::replace(&mut self.inside, true);
        for value in values(&signature.output) {
            let start = block.brace_token.span.open().byte_range().end;
            let change = format!("returns {} at once", if value.is_empty() { "()" } else { &value });
            let (line, function) = (signature.span().start().line, self.names.join("::"));
            self.points.push(Point {
                line,
                function,
                range: start..start,
                instead: value,
                change,
                returns: true,
            });
        }
        visit::visit_block(self, block);
        self.inside = before;
        self.names.pop();
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !is_test(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_type(&mut self, _: &'ast Type) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}

    fn visit_expr_repeat(&mut self, item: &'ast syn::ExprRepeat) {
        // The length is a constant.
        self.visit_expr(&item.expr);
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        self.function(&item.sig, &item.attrs, &item.block);
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        self.function(&item.sig, &item.attrs, &item.block);
    }

    fn visit_trait_item_fn(&mut self, item: &'ast syn::TraitItemFn) {
        if let Some(block) = &item.default {
            self.function(&item.sig, &item.attrs, block);
        }
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        let derived = item.trait_.as_ref().and_then(|(_, path, _)| path.segments.last());
        // Text for people is judged by people.
        if derived.is_some_and(|last| last.ident == "Debug") {
            return;
        }
        self.names.push(item.self_ty.to_token_stream().to_string().replace(' ', ""));
        visit::visit_item_impl(self, item);
        self.names.pop();
    }

    fn visit_expr_binary(&mut self, item: &'ast syn::ExprBinary) {
        if !holds_let(&item.left) && !holds_let(&item.right) {
            let (left, right) = (self.text(&*item.left).to_owned(), self.text(&*item.right).to_owned());
            let before = self.text(&item.op).to_owned();
            for after in others(&item.op) {
                let change = format!("{before} → {after} in `{}`", short(self.text(item)));
                self.push(item, format!("({left}) {after} ({right})"), change);
            }
        }
        visit::visit_expr_binary(self, item);
    }

    fn visit_expr_unary(&mut self, item: &'ast syn::ExprUnary) {
        let is_number = matches!(&*item.expr, Expr::Lit(_));
        if matches!(item.op, UnOp::Neg(_) | UnOp::Not(_)) && !is_number {
            let change = format!("without {} in `{}`", self.text(&item.op), short(self.text(item)));
            self.push(item, self.text(&*item.expr).to_owned(), change);
        }
        visit::visit_expr_unary(self, item);
    }
}

/// A piece of code on one line.
fn short(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(90) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line,
    }
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let text = attribute.meta.to_token_stream().to_string();
        text == "test" || text.starts_with("cfg (test") || text.starts_with("cfg (any (test")
    })
}

/// `if let … && …` has no value of its own.
fn holds_let(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(binary) => holds_let(&binary.left) || holds_let(&binary.right),
        _ => false,
    }
}

/// What stands instead of an operator.
fn others(operator: &BinOp) -> &'static [&'static str] {
    match operator {
        BinOp::Add(_) => &["-"],
        BinOp::Sub(_) => &["+"],
        BinOp::Mul(_) => &["/"],
        BinOp::Div(_) => &["*"],
        BinOp::Rem(_) => &["/"],
        BinOp::And(_) => &["||"],
        BinOp::Or(_) => &["&&"],
        BinOp::BitXor(_) | BinOp::BitAnd(_) => &["|"],
        BinOp::BitOr(_) => &["&"],
        BinOp::Shl(_) => &[">>"],
        BinOp::Shr(_) => &["<<"],
        BinOp::Eq(_) => &["!="],
        BinOp::Ne(_) => &["=="],
        BinOp::Lt(_) => &[">", "=="],
        BinOp::Le(_) => &[">"],
        BinOp::Gt(_) => &["<", "=="],
        BinOp::Ge(_) => &["<"],
        BinOp::AddAssign(_) => &["-="],
        BinOp::SubAssign(_) => &["+="],
        BinOp::MulAssign(_) => &["/="],
        BinOp::DivAssign(_) => &["*="],
        _ => &[],
    }
}

/// What a function may return instead of its value, by its type.
fn values(output: &ReturnType) -> Vec<String> {
    let ReturnType::Type(_, of) = output else { return vec![String::new()] };
    let name = of.to_token_stream().to_string().replace(' ', "");
    let list: &[&str] = match name.as_str() {
        "bool" => &["true", "false"],
        "f64" | "f32" => &["0.0", "1.0"],
        "usize" | "u8" | "u16" | "u32" | "u64" | "i32" | "i64" => &["0", "1"],
        "String" => &["String::new()"],
        "[f64;3]" => &["[0.0; 3]", "[1.0; 3]"],
        "[usize;3]" => &["[0; 3]"],
        "()" => &[""],
        _ if name.starts_with("Option<") => &["None"],
        _ if name.starts_with("Vec<") => &["Vec::new()"],
        _ if name.starts_with("Result<(),") => &["Ok(())"],
        _ => &[],
    };
    list.iter().map(|&value| value.to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_a_function() {
        let text = "const A: f64 = 1.0 + 2.0;\nfn f(a: f64) -> f64 {\n    -a * [a; 1 + 2][0] - 1.0\n}\n#[test]\nfn t() { 1 + 1; }\n";
        let found = of(text).expect("Rust");
        let changes: Vec<_> = found.iter().map(|point| (point.line, point.change.as_str())).collect();
        let expected = [
            (2, "returns 0.0 at once"),
            (2, "returns 1.0 at once"),
            (3, "- → + in `-a * [a; 1 + 2][0] - 1.0`"),
            (3, "* → / in `-a * [a; 1 + 2][0]`"),
            (3, "without - in `-a`"),
        ];
        assert_eq!(changes, expected);
        assert_eq!(found[3].instead, "(-a) / ([a; 1 + 2][0])");
        assert!(found.iter().all(|point| point.function == "f"));
    }

    #[test]
    fn conditions_with_patterns_stay() {
        let found = of("fn f(a: Option<u8>, b: bool) { if let Some(1) = a && b && !b {} }").expect("Rust");
        let changes: Vec<_> = found.iter().map(|point| point.change.as_str()).collect();
        assert_eq!(changes, ["returns () at once", "without ! in `!b`"]);
    }
}
