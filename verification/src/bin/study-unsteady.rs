//! Study `unsteady`: start-up, oscillation, and unyielded material at rest.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(
        &lahar_verification::claims::unsteady::STUDY,
        &lahar::solver::choose::Best,
    )
}
