//! Study `viscosity`: decay of shear waves and vortices, sound.
fn main() -> std::process::ExitCode {
    lahar_verification::study::main(
        &lahar_verification::claims::viscosity::STUDY,
        &lahar::solver::choose::Best,
    )
}
