//! Study `moments`: identities of the velocity set and the equilibrium.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(&lahar_verification::claims::moments::STUDY, &lahar::solver::choose::Best)
}
