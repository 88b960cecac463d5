//! Study `settling`: drag of regular arrays, falling spheres, random suspensions.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(
        &lahar_verification::claims::settling::STUDY,
        &lahar::solver::choose::Best,
    )
}
