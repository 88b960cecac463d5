//! Study `moments`: identities of the velocity set and the equilibrium.
fn main() -> std::process::ExitCode {
    lahar::verify::study::main(&lahar::verify::claims::moments::STUDY, &lahar::solver::choose::Best)
}
