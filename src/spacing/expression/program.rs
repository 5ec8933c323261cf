//! Expressions in x and y, compiled to a short postfix program that runs over any [`Number`]: floats for values,
//! [`Interval`]s for proved bounds, [`Gradient`]s for proved bounds of the derivatives.
//!
//! # Grammar
//! `+ - * / ^`, parentheses, numbers such as `1.5e-3`, the variables `x` and `y`, the constants `PI`, `pi` and `E`, and
//! the functions of [`FUNCTIONS`]. Powers bind tighter than signs and group to the right: `-x^2` = −(x²),
//! `2^3^2` = 2⁹.
//!
//! # Why not exmex's own parser
//! exmex 0.21 reads `-x^2` as (−x)², knows no exponents in numbers, misreads two-argument functions inside one another,
//! and cannot differentiate abs, min and max. Its symbolic derivatives are the oracle of the tests instead.

use crate::geometry::interval::Interval;

/// Deepest stack a program may need; a hand-written size function needs fewer than 10.
const STACK: usize = 24;

/// A function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Unary {
    Negate,
    Sin,
    Cos,
    Tan,
    Atan,
    Tanh,
    Exp,
    Ln,
    Sqrt,
    Abs,
}

/// A function of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Min,
    Max,
    Hypot,
}

/// What a name in front of a parenthesis means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// One argument.
    Unary(Unary),
    /// Two arguments, or more if the function is `min` or `max`.
    Binary(Binary),
}

/// Every function of the grammar. `hypot(a, b)` is √(a² + b²).
pub const FUNCTIONS: [(&str, Function); 13] = [
    ("sin", Function::Unary(Unary::Sin)),
    ("cos", Function::Unary(Unary::Cos)),
    ("tan", Function::Unary(Unary::Tan)),
    ("atan", Function::Unary(Unary::Atan)),
    ("tanh", Function::Unary(Unary::Tanh)),
    ("exp", Function::Unary(Unary::Exp)),
    ("ln", Function::Unary(Unary::Ln)),
    ("sqrt", Function::Unary(Unary::Sqrt)),
    ("abs", Function::Unary(Unary::Abs)),
    ("min", Function::Binary(Binary::Min)),
    ("max", Function::Binary(Binary::Max)),
    ("pow", Function::Binary(Binary::Power)),
    ("hypot", Function::Binary(Binary::Hypot)),
];

/// One step of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Step {
    Constant(f64),
    X,
    Y,
    Unary(Unary),
    Binary(Binary),
    /// A whole exponent.
    PowerWhole(i32),
    /// Any other fixed exponent.
    PowerFixed(f64),
}

impl Step {
    fn operands(self) -> usize {
        match self {
            Self::Constant(_) | Self::X | Self::Y => 0,
            Self::Unary(_) | Self::PowerWhole(_) | Self::PowerFixed(_) => 1,
            Self::Binary(_) => 2,
        }
    }
}

/// The numbers that a program computes with.
pub trait Number: Copy {
    /// The number that stands for a constant.
    fn constant(value: f64) -> Self;
    /// Applies a function of one argument.
    fn unary(self, function: Unary) -> Self;
    /// Applies a function of two arguments.
    fn binary(self, function: Binary, other: Self) -> Self;
    /// The power with a whole exponent.
    fn power_whole(self, exponent: i32) -> Self;
    /// The power with a fixed exponent.
    fn power_fixed(self, exponent: f64) -> Self;
}

/// A compiled expression.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    steps: Vec<Step>,
    height: usize,
    highest: usize,
}

impl Program {
    /// The value at (x, y).
    pub fn run<N: Number>(&self, x: N, y: N) -> N {
        let mut stack = [x; STACK];
        let mut height = 0;
        for step in &self.steps {
            match *step {
                Step::Constant(value) => stack[height] = N::constant(value),
                Step::X => stack[height] = x,
                Step::Y => stack[height] = y,
                Step::Unary(function) => stack[height - 1] = stack[height - 1].unary(function),
                Step::PowerWhole(exponent) => stack[height - 1] = stack[height - 1].power_whole(exponent),
                Step::PowerFixed(exponent) => stack[height - 1] = stack[height - 1].power_fixed(exponent),
                Step::Binary(function) => {
                    stack[height - 2] = stack[height - 2].binary(function, stack[height - 1]);
                    height -= 1;
                }
            }
            height += usize::from(step.operands() == 0);
        }
        stack[0]
    }

    /// Whether the program needs more than [`STACK`] numbers on its stack.
    pub(super) fn is_too_deep(&self) -> bool {
        self.highest > STACK
    }

    pub(super) fn push_constant(&mut self, value: f64) {
        self.push(Step::Constant(value));
    }

    pub(super) fn push_variable(&mut self, name: &str) {
        self.push(if name == "x" { Step::X } else { Step::Y });
    }

    /// Appends a function of one argument; constants are folded, √(a² + b²) becomes hypot, whose bounds are tighter.
    pub(super) fn push_unary(&mut self, function: Unary) {
        if let Some(&Step::Constant(value)) = self.steps.last() {
            self.steps.pop();
            self.height -= 1;
            return self.push_constant(value.unary(function));
        }
        if function == Unary::Sqrt && self.fold_hypot() {
            return;
        }
        self.push(Step::Unary(function));
    }

    /// Appends a function of two arguments; constants are folded, and a · a becomes a².
    pub(super) fn push_binary(&mut self, function: Binary) {
        let count = self.steps.len();
        if let [.., Step::Constant(left), Step::Constant(right)] = self.steps[..] {
            self.steps.truncate(count - 2);
            self.height -= 2;
            return self.push_constant(left.binary(function, right));
        }
        if let (Binary::Power, Some(&Step::Constant(exponent))) = (function, self.steps.last()) {
            self.steps.pop();
            self.height -= 1;
            let is_whole = exponent.fract() == 0.0 && exponent.abs() <= 64.0;
            return self.push(if is_whole {
                Step::PowerWhole(exponent as i32)
            } else {
                Step::PowerFixed(exponent)
            });
        }
        let middle = self.operand_start(count);
        if function == Binary::Multiply {
            let first = self.operand_start(middle);
            if self.steps[first..middle] == self.steps[middle..] {
                self.steps.truncate(middle);
                self.height -= 1;
                return self.push(Step::PowerWhole(2));
            }
        }
        self.push(Step::Binary(function));
    }

    /// Turns the trailing a² + b² into hypot(a, b).
    fn fold_hypot(&mut self) -> bool {
        let square = Step::PowerWhole(2);
        let [.., last, Step::Binary(Binary::Add)] = self.steps[..] else {
            return false;
        };
        let count = self.steps.len() - 1;
        let middle = self.operand_start(count);
        if last != square || self.steps[middle - 1] != square {
            return false;
        }
        self.steps.truncate(count - 1);
        self.steps.remove(middle - 1);
        self.steps.push(Step::Binary(Binary::Hypot));
        true
    }

    /// Where the operand that ends before step `end` starts.
    fn operand_start(&self, end: usize) -> usize {
        let mut wanted = 1;
        let mut start = end;
        while wanted > 0 {
            start -= 1;
            wanted = wanted + self.steps[start].operands() - 1;
        }
        start
    }

    fn push(&mut self, step: Step) {
        self.steps.push(step);
        self.height = self.height + 1 - step.operands();
        self.highest = self.highest.max(self.height);
    }
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    #[inline]
    fn unary(self, function: Unary) -> Self {
        match function {
            Unary::Negate => -self,
            Unary::Sin => self.sin(),
            Unary::Cos => self.cos(),
            Unary::Tan => self.tan(),
            Unary::Atan => self.atan(),
            Unary::Tanh => self.tanh(),
            Unary::Exp => self.exp(),
            Unary::Ln => self.ln(),
            Unary::Sqrt => self.sqrt(),
            Unary::Abs => self.abs(),
        }
    }

    #[inline]
    fn binary(self, function: Binary, other: Self) -> Self {
        match function {
            Binary::Add => self + other,
            Binary::Subtract => self - other,
            Binary::Multiply => self * other,
            Binary::Divide => self / other,
            Binary::Power => self.powf(other),
            Binary::Min => self.min(other),
            Binary::Max => self.max(other),
            Binary::Hypot => (self * self + other * other).sqrt(),
        }
    }

    #[inline]
    fn power_whole(self, exponent: i32) -> Self {
        if exponent == 2 {
            self * self
        } else {
            self.powi(exponent)
        }
    }

    #[inline]
    fn power_fixed(self, exponent: f64) -> Self {
        self.powf(exponent)
    }
}

impl Number for Interval {
    fn constant(value: f64) -> Self {
        Self::point(value)
    }

    fn unary(self, function: Unary) -> Self {
        match function {
            Unary::Negate => -self,
            Unary::Sin => self.sin(),
            Unary::Cos => self.cos(),
            Unary::Tan => self.tan(),
            Unary::Atan => self.atan(),
            Unary::Tanh => self.tanh(),
            Unary::Exp => self.exp(),
            Unary::Ln => self.ln(),
            Unary::Sqrt => self.sqrt(),
            Unary::Abs => self.abs(),
        }
    }

    fn binary(self, function: Binary, other: Self) -> Self {
        match function {
            Binary::Add => self + other,
            Binary::Subtract => self - other,
            Binary::Multiply => self * other,
            Binary::Divide => self / other,
            Binary::Power => self.power_varying(other),
            Binary::Min => self.min(other),
            Binary::Max => self.max(other),
            Binary::Hypot => self.hypot(other),
        }
    }

    fn power_whole(self, exponent: i32) -> Self {
        Interval::power_whole(self, exponent)
    }

    fn power_fixed(self, exponent: f64) -> Self {
        self.power(exponent)
    }
}

#[cfg(test)]
mod tests;
