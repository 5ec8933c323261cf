//! The command line: one file per verb. The library never prints; this layer does.

use std::process::ExitCode;

/// Parses the arguments, runs the verb and turns its outcome into the exit status of `design.md`.
pub fn main() -> ExitCode {
    ExitCode::SUCCESS
}
