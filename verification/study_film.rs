//! Study `film`: steady films on an incline under a free surface.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::film::STUDY, &lahar::solver::choose::Best)
}
