//! References to memory of a caller that is not written in Rust.
//!
//! Null, misaligned and too long memory is found here. That the memory exists, that it has the stated length and that nobody
//! else uses it at the same time, only the caller can know: these are the promises of every function in [`crate::abi`].

use std::slice;

use crate::status::ShagreenStatus;

/// Returns the value at a pointer; `None` if the pointer is null or misaligned.
///
/// # Safety
/// A pointer that is neither null nor misaligned points to a valid value, which nobody changes while it is borrowed.
pub(crate) unsafe fn shared<'a, T>(pointer: *const T) -> Option<&'a T> {
    if !pointer.is_aligned() {
        return None;
    }
    // SAFETY: `as_ref` checks for null, the line above checked the alignment, and the caller promises the rest.
    unsafe { pointer.as_ref() }
}

/// Returns the value at a pointer, to change it; `None` if the pointer is null or misaligned.
///
/// # Safety
/// A pointer that is neither null nor misaligned points to a valid value, which nobody else uses while it is borrowed.
pub(crate) unsafe fn exclusive<'a, T>(pointer: *mut T) -> Option<&'a mut T> {
    if !pointer.is_aligned() {
        return None;
    }
    // SAFETY: `as_mut` checks for null, the line above checked the alignment, and the caller promises the rest.
    unsafe { pointer.as_mut() }
}

/// Returns `n` values from a pointer on. The pointer of no values may be anything.
///
/// # Errors
/// The pointer is null or misaligned, or no memory holds this number of values.
///
/// # Safety
/// A pointer that is neither null nor misaligned points to `n` valid values, which nobody changes while they are borrowed.
pub(crate) unsafe fn items<'a, T>(pointer: *const T, n: usize) -> Result<&'a [T], ShagreenStatus> {
    if n == 0 {
        return Ok(&[]);
    }
    check(pointer, n)?;
    // SAFETY: pointer and length were checked above, and the caller promises the rest.
    Ok(unsafe { slice::from_raw_parts(pointer, n) })
}

/// Returns `n` values from a pointer on, to change them. The pointer of no values may be anything.
///
/// # Errors
/// The pointer is null or misaligned, or no memory holds this number of values.
///
/// # Safety
/// A pointer that is neither null nor misaligned points to `n` valid values, which nobody else uses while they are borrowed.
pub(crate) unsafe fn items_mut<'a, T>(pointer: *mut T, n: usize) -> Result<&'a mut [T], ShagreenStatus> {
    if n == 0 {
        return Ok(&mut []);
    }
    check(pointer, n)?;
    // SAFETY: pointer and length were checked above, and the caller promises the rest.
    Ok(unsafe { slice::from_raw_parts_mut(pointer, n) })
}

fn check<T>(pointer: *const T, n: usize) -> Result<(), ShagreenStatus> {
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(ShagreenStatus::Pointer);
    }
    // The whole memory must be addressable by a signed offset.
    if n > isize::MAX as usize / size_of::<T>().max(1) {
        return Err(ShagreenStatus::TooLong);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::ptr;

    use super::{exclusive, items, items_mut, shared};
    use crate::status::ShagreenStatus;

    #[test]
    fn null_misaligned_and_endless_memory_is_refused() {
        let mut values = [1.0_f32, 2.0];
        let start: *mut f32 = values.as_mut_ptr();
        let odd = start.wrapping_byte_add(1);
        let n_endless = isize::MAX as usize / 4 + 1;
        for (pointer, n, expected) in [
            (ptr::null_mut(), 2, ShagreenStatus::Pointer),
            (odd, 1, ShagreenStatus::Pointer),
            (start, n_endless, ShagreenStatus::TooLong),
        ] {
            // SAFETY: these pointers and lengths are refused.
            assert_eq!(unsafe { items(pointer, n) }.err(), Some(expected));
            // SAFETY: these pointers and lengths are refused.
            assert_eq!(unsafe { items_mut(pointer, n) }.err(), Some(expected));
        }
        for pointer in [ptr::null_mut(), odd] {
            // SAFETY: these pointers are refused.
            assert!(unsafe { shared(pointer) }.is_none());
            // SAFETY: these pointers are refused.
            assert!(unsafe { exclusive(pointer) }.is_none());
        }
        // SAFETY: no values are read.
        assert_eq!(unsafe { items(odd, 0) }, Ok(&[][..]));
        // SAFETY: the array has two values.
        assert_eq!(unsafe { items(start, 2) }, Ok(&[1.0, 2.0][..]));
    }
}
