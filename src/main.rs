//! Argument parsing only; each verb lives in `biting::cli`.

fn main() -> std::process::ExitCode {
    biting::cli::main()
}
