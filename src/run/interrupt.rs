//! Signals that ask a run to end.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown, register_usize};

/// What a terminal, a batch system and a closing session send.
#[cfg(unix)]
const SIGNALS: [i32; 3] = [SIGINT, SIGTERM, signal_hook::consts::SIGHUP];
#[cfg(not(unix))]
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// Listens for SIGINT, SIGTERM and, on Unix, SIGHUP. The first one is noted; the second one ends the process at once.
#[derive(Debug, Default)]
pub struct Interrupt {
    asked: Arc<AtomicBool>,
    signal: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Listens from now on. Signals that the process was started to ignore stay ignored, so that `nohup` works. On Unix a file
    /// that exceeds the size limit of the process becomes an error like any other instead of the end of the process.
    ///
    /// # Errors
    /// The system refuses.
    pub fn listen() -> io::Result<Self> {
        let new = Self::default();
        let ignored = ignored();
        for signal in SIGNALS.into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0) {
            // In this order: the signal that asks must not be the one that ends.
            register_conditional_shutdown(signal, 128 + signal, Arc::clone(&new.asked))?;
            register_usize(signal, Arc::clone(&new.signal), signal as usize)?;
            register(signal, Arc::clone(&new.asked))?;
        }
        #[cfg(unix)]
        register(signal_hook::consts::SIGXFSZ, Arc::new(AtomicBool::new(false)))?;
        Ok(new)
    }

    /// Becomes true at the first signal.
    #[must_use]
    pub fn flag(&self) -> &AtomicBool {
        &self.asked
    }

    /// 128 and the number of the signal, as shells have it: 130 for SIGINT, 143 for SIGTERM, 129 for SIGHUP.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        128_u8.saturating_add(u8::try_from(self.signal.load(Ordering::SeqCst)).unwrap_or(0))
    }
}

/// Signals that the process was started to ignore, signal n as bit n − 1; none where the system does not say.
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
