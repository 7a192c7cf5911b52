//! Serial ports: which there are.

use crate::error::{DeviceError, DeviceErrorKind};

/// How a serial port is connected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SerialPortKind {
    /// By USB, from a maker and product.
    Usb {
        /// Number of the maker.
        vendor_id: u16,
        /// The maker's number of the product.
        product_id: u16,
    },
    /// On the bus of the machine.
    Pci,
    /// By Bluetooth.
    Bluetooth,
    /// The system does not say.
    Unknown,
}

/// One serial port of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SerialPortInfo {
    /// Name by which it is opened.
    pub id: String,
    /// Name to show: that of the product where it is known.
    pub name: String,
    /// How it is connected.
    pub kind: SerialPortKind,
}

/// The serial ports of this machine, by name.
///
/// # Errors
/// - [`DeviceErrorKind::Backend`] where the system does not give its list.
pub fn list_serial_ports() -> Result<Vec<SerialPortInfo>, DeviceError> {
    let ports = serialport::available_ports().map_err(|error| {
        DeviceError::new(DeviceErrorKind::Backend, format!("the serial ports cannot be listed: {error}"))
    })?;
    let mut ports: Vec<_> = ports.into_iter().map(describe).collect();
    ports.sort_by(|a, b| a.id.cmp(&b.id));
    Ok(ports)
}

fn describe(port: serialport::SerialPortInfo) -> SerialPortInfo {
    let (kind, product) = match port.port_type {
        serialport::SerialPortType::UsbPort(usb) => {
            (SerialPortKind::Usb { vendor_id: usb.vid, product_id: usb.pid }, usb.product)
        }
        serialport::SerialPortType::PciPort => (SerialPortKind::Pci, None),
        serialport::SerialPortType::BluetoothPort => (SerialPortKind::Bluetooth, None),
        serialport::SerialPortType::Unknown => (SerialPortKind::Unknown, None),
    };
    let name = product.unwrap_or_else(|| port.port_name.clone());
    SerialPortInfo { id: port.port_name, name, kind }
}

#[cfg(test)]
mod tests {
    use super::{SerialPortKind, describe, list_serial_ports};

    #[test]
    fn lists_without_opening_in_order() {
        let ports = list_serial_ports().unwrap();
        assert!(ports.windows(2).all(|w| w[0].id <= w[1].id));
    }

    #[test]
    fn a_port_is_shown_by_its_product() {
        let usb = serialport::UsbPortInfo {
            vid: 0x2341,
            pid: 0x0043,
            serial_number: None,
            manufacturer: None,
            product: Some("Uno".into()),
        };
        let named = describe(serialport::SerialPortInfo {
            port_name: "ttyACM0".into(),
            port_type: serialport::SerialPortType::UsbPort(usb),
        });
        assert_eq!((named.id.as_str(), named.name.as_str()), ("ttyACM0", "Uno"));
        assert_eq!(named.kind, SerialPortKind::Usb { vendor_id: 0x2341, product_id: 0x0043 });
        let plain = describe(serialport::SerialPortInfo {
            port_name: "ttyS0".into(),
            port_type: serialport::SerialPortType::Unknown,
        });
        assert_eq!((plain.name.as_str(), plain.kind), ("ttyS0", SerialPortKind::Unknown));
    }
}
