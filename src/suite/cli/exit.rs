//! The exit statuses, and errors as one readable message.

use super::output::say_aside;
use std::fmt::Display;
use std::process::ExitCode;

/// Why a verb did not end with status 0. Every text says what to do.
#[derive(Debug)]
pub enum Failure {
    /// 1: a guaranteed check or an expectation failed.
    Broken(String),
    /// 2: bad usage or bad input.
    Input(String),
    /// 3: nothing could be measured.
    NothingMeasured(String),
    /// 4: declined, or stopped by a budget.
    Declined(String),
}

/// What a verb returns.
pub type Outcome = Result<(), Failure>;

impl Failure {
    /// Bad input, in the words of `error`.
    pub fn input(error: impl Display) -> Self {
        Self::Input(error.to_string())
    }

    /// The exit status.
    pub fn status(&self) -> u8 {
        match self {
            Self::Broken(_) => 1,
            Self::Input(_) => 2,
            Self::NothingMeasured(_) => 3,
            Self::Declined(_) => 4,
        }
    }

    fn message(&self) -> &str {
        match self {
            Self::Broken(text) | Self::Input(text) | Self::NothingMeasured(text) | Self::Declined(text) => text,
        }
    }

    /// Prints the message to standard error and gives the exit status.
    pub fn tell(&self) -> ExitCode {
        let handler = miette::MietteHandlerOpts::new().width(120).wrap_lines(false);
        // A second call keeps the first hook, which is the same one.
        let _ = miette::set_hook(Box::new(move |_| Box::new(handler.clone().build())));
        say_aside(format_args!("{:?}", miette::Report::msg(self.message().to_owned())));
        ExitCode::from(self.status())
    }
}
