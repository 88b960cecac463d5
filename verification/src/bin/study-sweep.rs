//! Study `sweep`: random steady flows between walls.
fn main() -> std::process::ExitCode {
    lahar_verification::claims::sweep::main(&lahar::solver::choose::Best)
}
