//! Study `slump`: heaps and columns of yield-stress fluid that come to rest on a floor.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(&lahar_verification::claims::slump::STUDY, &lahar::solver::choose::Best)
}
