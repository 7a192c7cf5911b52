//! Selection of the compute device for networks.

use candle_core::Device;

/// Returns a GPU if the program was built with CUDA and one is available, else the CPU.
pub(crate) fn best() -> Device {
    #[cfg(feature = "cuda")]
    if let Ok(device) = Device::new_cuda(0) {
        return device;
    }
    Device::Cpu
}
