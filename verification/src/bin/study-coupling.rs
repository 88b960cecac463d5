//! Study `coupling`: grains and fluid, each pushing the other; books, lubrication, free surface.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(
        &lahar_verification::claims::coupling::STUDY,
        &lahar::solver::choose::Best,
    )
}
