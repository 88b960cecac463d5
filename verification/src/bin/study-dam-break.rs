//! Study `dam-break`: flows released on the horizontal and on slopes.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(
        &lahar_verification::claims::dam_break::STUDY,
        &lahar::solver::choose::Best,
    )
}
