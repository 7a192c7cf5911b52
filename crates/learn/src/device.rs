//! Where networks are worked out.

use candle_core::Device;

/// A graphics card where the program was built for one and there is one, else the processor.
pub(crate) fn best() -> Device {
    #[cfg(feature = "cuda")]
    if let Ok(device) = Device::new_cuda(0) {
        return device;
    }
    Device::Cpu
}
