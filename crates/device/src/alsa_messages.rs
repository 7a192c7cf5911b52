//! Messages of the ALSA library on standard error. Its errors are returned as well, and are reported with what to do.

use std::ffi::{c_char, c_int, c_void};

/// Handler of messages: file, line, function, error number, format, and its arguments (a `va_list`, which is passed as
/// one pointer).
type Handler = extern "C" fn(*const c_char, c_int, *const c_char, c_int, *const c_char, *mut c_void);

// The library is linked by `cpal`, which uses it through the crate `alsa-sys`.
unsafe extern "C" {
    /// Sets the handler of the current thread and returns the previous one.
    fn snd_lib_error_set_local(handler: Option<Handler>) -> Option<Handler>;
}

extern "C" fn discard(
    _file: *const c_char,
    _line: c_int,
    _function: *const c_char,
    _error: c_int,
    _format: *const c_char,
    _arguments: *mut c_void,
) {
}

/// Discards the messages that the current thread would cause from now on.
pub(crate) fn silence() {
    // SAFETY: the function stores the pointer for the current thread. `discard` lives as long as the program, has the
    // type that ALSA calls, and reads none of its arguments.
    unsafe { snd_lib_error_set_local(Some(discard)) };
}

#[cfg(test)]
mod tests {
    use super::{silence, snd_lib_error_set_local};

    #[test]
    fn only_the_thread_that_asks_is_silent() {
        // SAFETY: without a handler, ALSA uses its own.
        let handler = || unsafe { snd_lib_error_set_local(None) };
        let of_other = std::thread::spawn(move || {
            silence();
            handler().is_some()
        });
        assert!(of_other.join().unwrap());
        assert!(std::thread::spawn(move || handler().is_none()).join().unwrap());
    }
}
