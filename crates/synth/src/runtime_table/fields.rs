//! Little-endian numbers at the begin of bytes.

/// Bytes of which each call takes a number. A call returns `None` if too few are left.
pub(super) struct Fields<'b>(pub(super) &'b [u8]);

impl<'b> Fields<'b> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk::<N>()?;
        self.0 = rest;
        Some(*first)
    }

    /// The next `n` bytes.
    pub(super) fn bytes(&mut self, n: usize) -> Option<&'b [u8]> {
        let (first, rest) = self.0.split_at_checked(n)?;
        self.0 = rest;
        Some(first)
    }

    /// Four letters.
    pub(super) fn letters(&mut self) -> Option<[u8; 4]> {
        self.take()
    }

    pub(super) fn u16(&mut self) -> Option<u16> {
        self.take().map(u16::from_le_bytes)
    }

    pub(super) fn u32(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    pub(super) fn f32(&mut self) -> Option<f32> {
        self.take().map(f32::from_le_bytes)
    }

    pub(super) fn f64(&mut self) -> Option<f64> {
        self.take().map(f64::from_le_bytes)
    }

    pub(super) fn indices(&mut self) -> Option<[u16; 3]> {
        Some([self.u16()?, self.u16()?, self.u16()?])
    }

    pub(super) fn floats<const N: usize>(&mut self) -> Option<[f32; N]> {
        let mut floats = [0.0; N];
        for x in &mut floats {
            *x = self.f32()?;
        }
        Some(floats)
    }

    /// Line spectral frequencies; those above the order are zero. `None` if the order is above `N`, too.
    pub(super) fn lsf<const N: usize>(&mut self, order: usize) -> Option<[f32; N]> {
        let mut lsf = [0.0; N];
        for w in lsf.get_mut(..order)? {
            *w = self.f32()?;
        }
        Some(lsf)
    }
}
