//! Argument parsing only; each verb lives in `biting::suite::cli`.

fn main() -> std::process::ExitCode {
    biting::suite::main()
}
