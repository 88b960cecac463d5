//! Golden files: as blessed, older than their code, computed again.
fn main() -> std::process::ExitCode {
    lahar_verification::verify::main(&lahar::solver::choose::Best)
}
