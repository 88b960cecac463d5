//! Study `unsteady`: start-up, oscillation, and unyielded material at rest.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::unsteady::STUDY, &lahar::solver::choose::Best)
}
