//! Study `stability`: von Neumann analysis and runs driven unstable on purpose.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(
        &lahar_verification::claims::stability::STUDY,
        &lahar::solver::choose::Best,
    )
}
