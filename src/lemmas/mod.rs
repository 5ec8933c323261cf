//! The paper, checked line by line: every statement with a bound as a record, judged twice.
//!
//! * **Numerically** ([`search`]): the optimum of the bounded quantity over all configurations that the hypotheses allow, bracketed by
//!   interval branch and bound, against the printed formula, over a grid of the parameter.
//! * **On meshes** ([`measured`]): the worst margin over all committed rows, with the cell it was seen in.
//!
//! [`statements`] has the records in the order of the paper, [`errata`] what came out beside numbers.

pub mod judge;
pub mod record;
pub mod search;
pub mod slopes;
pub mod statements;
#[cfg(test)]
mod tests;
