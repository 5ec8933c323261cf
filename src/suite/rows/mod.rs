//! What an experiment leaves: records, the journal of a run in progress, the tables of a finished one, and what made them.

pub mod adapted;
pub mod hash;
pub mod journal;
pub mod machine;
pub mod numbers;
pub mod record;
pub mod tables;
pub mod tally;
pub mod times;
