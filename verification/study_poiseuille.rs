//! Study `poiseuille`: channels, ducts, pipes and Couette flow of all fluids.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::poiseuille::STUDY, &lahar::solver::choose::Best)
}
