//! Mutants of everything that lahar reads.
fn main() -> std::process::ExitCode {
    lahar_verification::fuzz::main()
}
