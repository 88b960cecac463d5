//! Study `film`: steady films on an incline under a free surface.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(&lahar_verification::claims::film::STUDY, &lahar::solver::choose::Best)
}
