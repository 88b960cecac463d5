//! Study `settling`: drag of regular arrays, falling spheres, random suspensions.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::settling::STUDY, &lahar::solver::choose::Best)
}
