//! Text → [`Program`]: a precedence-climbing parser whose errors name the column.

use crate::spacing::expression::program::{Binary, FUNCTIONS, Function, Program, Unary};

/// What is wrong with a text, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("column {column}: {message}")]
pub struct GrammarError {
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong and what to write instead.
    pub message: String,
}

/// How deep parentheses may nest, which keeps the parser's own stack small.
const NESTING: usize = 64;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Token<'a> {
    Number(f64),
    Name(&'a str),
    Symbol(char),
    End,
}

impl Token<'_> {
    fn describe(self) -> String {
        match self {
            Self::Number(value) => format!("the number {value}"),
            Self::Name(name) => format!("`{name}`"),
            Self::Symbol(symbol) => format!("`{symbol}`"),
            Self::End => "the end".into(),
        }
    }
}

struct Parser<'a> {
    text: &'a str,
    /// Byte offsets of the current token and of what follows it.
    start: usize,
    next: usize,
    token: Token<'a>,
    nesting: usize,
    program: Program,
}

/// Compiles an expression in x and y; the grammar is that of [`Program`]'s module.
///
/// # Errors
/// With the column: unknown names, missing operands or parentheses, two operands without an operator, wrong numbers of
/// arguments, numbers out of range, expressions nested too deeply.
pub fn compile(text: &str) -> Result<Program, GrammarError> {
    let mut parser = Parser {
        text,
        start: 0,
        next: 0,
        token: Token::End,
        nesting: 0,
        program: Program::default(),
    };
    parser.advance()?;
    parser.sum()?;
    if parser.token != Token::End {
        return Err(parser.error(match parser.token {
            Token::Symbol(')') => "`)` without `(`".into(),
            token => format!("an operator is missing before {}", token.describe()),
        }));
    }
    if parser.program.is_too_deep() {
        parser.start = 0;
        return Err(parser.error("the expression is nested too deeply".into()));
    }
    Ok(parser.program)
}

impl<'a> Parser<'a> {
    fn error(&self, message: String) -> GrammarError {
        GrammarError {
            column: self.text[..self.start].chars().count() + 1,
            message,
        }
    }

    fn advance(&mut self) -> Result<(), GrammarError> {
        let rest = self.text[self.next..].trim_start();
        self.start = self.text.len() - rest.len();
        let take = |accept: fn(char) -> bool| rest.find(|c| !accept(c)).unwrap_or(rest.len());
        let (token, length) = match rest.chars().next() {
            None => (Token::End, 0),
            Some(c) if c.is_ascii_digit() || c == '.' => {
                let length = number_length(rest);
                let value = rest[..length].parse::<f64>().ok().filter(|value| value.is_finite());
                let value = value.ok_or_else(|| self.error(format!("`{}` is no number", &rest[..length])))?;
                (Token::Number(value), length)
            }
            Some(c) if c.is_alphabetic() || c == '_' => {
                let length = take(|c| c.is_alphanumeric() || c == '_');
                (Token::Name(&rest[..length]), length)
            }
            Some(c) if "+-*/^(),".contains(c) => (Token::Symbol(c), 1),
            Some(c) => return Err(self.error(format!("`{c}` has no meaning here"))),
        };
        self.token = token;
        self.next = self.start + length;
        Ok(())
    }

    fn expect(&mut self, symbol: char, why: &str) -> Result<(), GrammarError> {
        if self.token != Token::Symbol(symbol) {
            return Err(self.error(format!("`{symbol}` expected {why}, found {}", self.token.describe())));
        }
        self.advance()
    }

    /// One of `symbols`, if it comes next.
    fn accept(&mut self, symbols: &str) -> Result<Option<char>, GrammarError> {
        match self.token {
            Token::Symbol(symbol) if symbols.contains(symbol) => {
                self.advance()?;
                Ok(Some(symbol))
            }
            _ => Ok(None),
        }
    }

    fn sum(&mut self) -> Result<(), GrammarError> {
        self.nesting += 1;
        if self.nesting > NESTING {
            return Err(self.error("the expression is nested too deeply".into()));
        }
        self.product()?;
        while let Some(sign) = self.accept("+-")? {
            self.product()?;
            self.program
                .push_binary(if sign == '+' { Binary::Add } else { Binary::Subtract });
        }
        self.nesting -= 1;
        Ok(())
    }

    fn product(&mut self) -> Result<(), GrammarError> {
        self.signed()?;
        while let Some(operator) = self.accept("*/")? {
            self.signed()?;
            self.program.push_binary(if operator == '*' {
                Binary::Multiply
            } else {
                Binary::Divide
            });
        }
        Ok(())
    }

    /// Signs bind looser than powers: −x² is −(x²).
    fn signed(&mut self) -> Result<(), GrammarError> {
        let mut negative = false;
        while let Some(sign) = self.accept("+-")? {
            negative ^= sign == '-';
        }
        self.power()?;
        if negative {
            self.program.push_unary(Unary::Negate);
        }
        Ok(())
    }

    fn power(&mut self) -> Result<(), GrammarError> {
        self.nesting += 1;
        if self.nesting > NESTING {
            return Err(self.error("the expression is nested too deeply".into()));
        }
        self.operand()?;
        if self.accept("^")?.is_some() {
            // The exponent may have a sign and another power: 2^-x^2.
            self.signed()?;
            self.program.push_binary(Binary::Power);
        }
        self.nesting -= 1;
        Ok(())
    }

    fn operand(&mut self) -> Result<(), GrammarError> {
        match self.token {
            Token::Number(value) => {
                self.program.push_constant(value);
                self.advance()
            }
            Token::Symbol('(') => {
                self.advance()?;
                self.sum()?;
                self.expect(')', "to close the parenthesis")
            }
            Token::Name(name) => self.named(name),
            token => Err(self.error(format!(
                "a number, x, y or a function expected, found {}",
                token.describe()
            ))),
        }
    }

    fn named(&mut self, name: &str) -> Result<(), GrammarError> {
        match name {
            "x" | "y" => self.program.push_variable(name),
            "PI" | "pi" => self.program.push_constant(std::f64::consts::PI),
            "E" => self.program.push_constant(std::f64::consts::E),
            _ => return self.call(name),
        }
        self.advance()
    }

    fn call(&mut self, name: &str) -> Result<(), GrammarError> {
        let Some(&(_, function)) = FUNCTIONS.iter().find(|(known, _)| *known == name) else {
            let known: Vec<&str> = FUNCTIONS.iter().map(|(known, _)| *known).collect();
            return Err(self.error(format!(
                "`{name}` is unknown; there are x, y, PI, E, {}",
                known.join(", ")
            )));
        };
        self.advance()?;
        self.expect('(', &format!("after {name}"))?;
        self.sum()?;
        match function {
            Function::Unary(unary) => self.program.push_unary(unary),
            Function::Binary(binary) => {
                self.expect(',', &format!("between the arguments of {name}"))?;
                self.sum()?;
                self.program.push_binary(binary);
                while matches!(binary, Binary::Min | Binary::Max) && self.accept(",")?.is_some() {
                    self.sum()?;
                    self.program.push_binary(binary);
                }
            }
        }
        self.expect(')', &format!("after the arguments of {name}"))
    }
}

/// Bytes of the number at the start of `text`: digits, a point, an exponent.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| from + bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(end + 1 + sign);
        if exponent > end + 1 + sign {
            end = exponent;
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str, x: f64, y: f64) -> f64 {
        compile(text)
            .unwrap_or_else(|error| panic!("{text}: {error}"))
            .run(x, y)
    }

    fn told(text: &str) -> String {
        compile(text).unwrap_err().to_string()
    }

    #[test]
    fn numbers_have_digits_a_point_and_an_exponent() {
        for (text, value) in [
            ("12", 12.0),
            ("1.", 1.0),
            (".5", 0.5),
            ("0.25", 0.25),
            ("1e2", 100.0),
            ("1E+2", 100.0),
            ("25e-2", 0.25),
            ("1.5e0+1", 2.5),
            ("2.e1-1", 19.0),
        ] {
            assert_eq!(at(text, 0.0, 0.0), value, "{text}");
        }
        // Anything but an exponent is a name.
        assert_eq!(told("2e"), "column 2: an operator is missing before `e`");
        assert_eq!(told("2e+x"), "column 2: an operator is missing before `e`");
        assert_eq!(told("1.5.2"), "column 4: an operator is missing before the number 0.2");
        assert_eq!(told("x+."), "column 3: `.` is no number");
        assert_eq!(told("1e999"), "column 1: `1e999` is no number");
    }

    #[test]
    fn names_are_letters_digits_and_underlines() {
        for (text, value) in [
            ("x", 3.0),
            ("y", 5.0),
            ("PI", std::f64::consts::PI),
            ("pi", std::f64::consts::PI),
        ] {
            assert_eq!(at(text, 3.0, 5.0), value);
        }
        assert_eq!(at(" E ", 3.0, 5.0), std::f64::consts::E);
        for name in ["x1", "_x", "x_1", "e", "sine", "ä"] {
            assert!(
                told(&format!("1+{name}"))
                    .starts_with(&format!("column 3: `{name}` is unknown; there are x, y, PI, E, "))
            );
        }
        assert_eq!(told("sin"), "column 4: `(` expected after sin, found the end");
        assert_eq!(told("x y"), "column 3: an operator is missing before `y`");
        assert_eq!(told("x, y"), "column 2: an operator is missing before `,`");
        assert_eq!(told("é é"), told("é"));
        assert_eq!(told("x $"), "column 3: `$` has no meaning here");
    }

    #[test]
    fn signs_add_up() {
        for (text, value) in [
            ("-x", -3.0),
            ("--x", 3.0),
            ("-+-x", 3.0),
            ("+x", 3.0),
            ("---x", -3.0),
            ("2--x", 5.0),
            ("2+-x", -1.0),
        ] {
            assert_eq!(at(text, 3.0, 5.0), value, "{text}");
        }
        for (text, value) in [
            ("2*-x", -6.0),
            ("2^-x", 0.125),
            ("-x^2", -9.0),
            ("x-y-1", -3.0),
            ("x/y/2", 0.3),
            ("x*y+1", 16.0),
        ] {
            assert_eq!(at(text, 3.0, 5.0), value, "{text}");
        }
    }

    #[test]
    fn functions_take_the_arguments_they_have() {
        for (text, value) in [
            ("min(x, y, 1, 7)", 1.0),
            ("max(x, y, 1, 7)", 7.0),
            ("min(x, y)", 3.0),
            ("pow(x, 2)", 9.0),
            ("hypot(x+1, y-2)", 5.0),
            ("abs(x-y)", 2.0),
            ("sqrt(x+1)", 2.0),
        ] {
            assert_eq!(at(text, 3.0, 5.0), value, "{text}");
        }
        assert_eq!(
            told("pow(x, 2, 3)"),
            "column 9: `)` expected after the arguments of pow, found `,`"
        );
        assert_eq!(
            told("sin(x, y)"),
            "column 6: `)` expected after the arguments of sin, found `,`"
        );
        assert_eq!(
            told("min(x)"),
            "column 6: `,` expected between the arguments of min, found `)`"
        );
        assert_eq!(
            told("min(x, y"),
            "column 9: `)` expected after the arguments of min, found the end"
        );
    }

    #[test]
    fn parentheses_and_powers_nest_so_deep_and_no_deeper() {
        // A pair opens a sum and a power, of which there may be 64 at once.
        let pairs = |count: usize| format!("{}x{}", "(".repeat(count), ")".repeat(count));
        assert_eq!(at(&pairs(31), 3.0, 5.0), 3.0);
        assert_eq!(told(&pairs(32)), "column 33: the expression is nested too deeply");
        assert_eq!(
            told(&format!("{}1", "1^".repeat(70))),
            "column 127: the expression is nested too deeply"
        );
        // One after another there may be any number.
        assert_eq!(at(&format!("{}0", "(x)^1+".repeat(100)), 3.0, 5.0), 300.0);
    }

    #[test]
    fn columns_count_characters() {
        assert_eq!(told("  1 + é"), told("  1 + é").replace("column 6", "column 7"));
        assert!(told("  1 + é").starts_with("column 7: `é`"));
        assert!(told("x+§").starts_with("column 3: `§` has no meaning"));
        let error = compile("1+)").unwrap_err();
        assert_eq!(
            (error.column, error.message.as_str()),
            (3, "a number, x, y or a function expected, found `)`")
        );
    }
}
