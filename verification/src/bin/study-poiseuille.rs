//! Study `poiseuille`: channels, ducts, pipes and Couette flow of all fluids.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(
        &lahar_verification::claims::poiseuille::STUDY,
        &lahar::solver::choose::Best,
    )
}
