//! Serial ports: listing, and resolving an id to a port.

use crate::error::{DeviceError, DeviceErrorKind};

/// Prefix of the ids of serial outputs.
pub const ID_PREFIX: &str = "serial:";
/// Prefix of port names that identify a USB port by vendor, product and serial number.
const USB_PREFIX: &str = "usb-";

/// Connection type of a serial port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SerialPortKind {
    /// USB.
    Usb {
        /// Vendor id.
        vendor_id: u16,
        /// Product id, assigned by the vendor.
        product_id: u16,
    },
    /// Bus of the machine, such as PCI.
    Pci,
    /// Bluetooth.
    Bluetooth,
    /// Unknown to the system.
    Unknown,
}

/// One serial port of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SerialPortInfo {
    /// Id that opens it as an output. If vendor, product and serial number are unique, it is
    /// `serial:usb-VVVV-PPPP-SERIAL`, which does not depend on the USB socket. Otherwise it is `serial:` and the port's
    /// name.
    pub id: String,
    /// Current system name of the port.
    pub port: String,
    /// Display name: the product name if known, otherwise the port's name.
    pub name: String,
    /// Connection type.
    pub kind: SerialPortKind,
}

/// Folder in which Linux lists its serial ports.
#[cfg(target_os = "linux")]
const LINUX_LIST: &str = "/sys/class/tty";

/// Lists the serial ports of this machine, sorted by id. None is opened.
///
/// # Errors
/// - [`DeviceErrorKind::Unavailable`] if the system has no list, as in a bare root folder.
/// - [`DeviceErrorKind::Backend`] if the system cannot list them.
pub fn list_serial_ports() -> Result<Vec<SerialPortInfo>, DeviceError> {
    #[cfg(target_os = "linux")]
    check_list(std::path::Path::new(LINUX_LIST))?;
    let ports = serialport::available_ports().map_err(|error| {
        DeviceError::new(
            DeviceErrorKind::Backend,
            format!("the serial ports cannot be listed: {error}; try again"),
        )
    })?;
    Ok(describe(ports))
}

/// Returns an error for a list that cannot be read, on which the library for serial ports panics.
#[cfg(target_os = "linux")]
fn check_list(folder: &std::path::Path) -> Result<(), DeviceError> {
    let problem = |error: std::io::Error| {
        let message = format!("the serial ports cannot be listed: {}: {error}; mount /sys", folder.display());
        DeviceError::new(DeviceErrorKind::Unavailable, message)
    };
    std::fs::read_dir(folder).map(|_| ()).map_err(problem)
}

/// Returns the current system name of the port with an id; the prefix `serial:` is optional.
///
/// # Errors
/// - [`DeviceErrorKind::NotFound`] if no USB port with this vendor, product and serial number is connected.
/// - [`DeviceErrorKind::Backend`] if the system cannot list ports.
pub(super) fn resolve(id: &str) -> Result<String, DeviceError> {
    let name = id.strip_prefix(ID_PREFIX).unwrap_or(id);
    if !name.starts_with(USB_PREFIX) {
        // This is a system name; opening the port checks whether it exists.
        return Ok(name.into());
    }
    resolve_among(name, list_serial_ports()?)
}

fn resolve_among(name: &str, ports: Vec<SerialPortInfo>) -> Result<String, DeviceError> {
    let found = ports.into_iter().find(|port| port.id.strip_prefix(ID_PREFIX) == Some(name));
    found.map(|port| port.port).ok_or_else(|| {
        let message = format!(
            "no serial port `{ID_PREFIX}{name}` is connected; plug it in, or choose one that `shagreen devices` lists"
        );
        DeviceError::new(DeviceErrorKind::NotFound, message)
    })
}

fn describe(mut ports: Vec<serialport::SerialPortInfo>) -> Vec<SerialPortInfo> {
    // On macOS a port has two names; the one for outgoing connections (`cu`) does not wait for a carrier.
    let names: Vec<String> = ports.iter().map(|port| port.port_name.clone()).collect();
    ports.retain(|port| match port.port_name.strip_prefix("/dev/tty.") {
        Some(rest) => !names.contains(&format!("/dev/cu.{rest}")),
        None => true,
    });
    let keys: Vec<Option<String>> = ports.iter().map(usb_key).collect();
    let is_one = |key: &String| keys.iter().flatten().filter(|other| *other == key).count() == 1;
    let mut described: Vec<SerialPortInfo> = ports
        .into_iter()
        .zip(&keys)
        .map(|(port, key)| {
            let name = key.clone().filter(is_one).unwrap_or_else(|| port.port_name.clone());
            describe_one(port, format!("{ID_PREFIX}{name}"))
        })
        .collect();
    described.sort_by(|a, b| a.id.cmp(&b.id));
    described
}

/// Name of a USB port that does not depend on its socket.
fn usb_key(port: &serialport::SerialPortInfo) -> Option<String> {
    let serialport::SerialPortType::UsbPort(usb) = &port.port_type else { return None };
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let serial: String = usb.serial_number.iter().flat_map(|number| number.chars()).map(plain).collect();
    let separator = if serial.is_empty() { "" } else { "-" };
    Some(format!("{USB_PREFIX}{:04x}-{:04x}{separator}{serial}", usb.vid, usb.pid))
}

fn describe_one(port: serialport::SerialPortInfo, id: String) -> SerialPortInfo {
    let (kind, product) = match port.port_type {
        serialport::SerialPortType::UsbPort(usb) => {
            (SerialPortKind::Usb { vendor_id: usb.vid, product_id: usb.pid }, usb.product)
        }
        serialport::SerialPortType::PciPort => (SerialPortKind::Pci, None),
        serialport::SerialPortType::BluetoothPort => (SerialPortKind::Bluetooth, None),
        serialport::SerialPortType::Unknown => (SerialPortKind::Unknown, None),
    };
    let name = product.unwrap_or_else(|| port.port_name.clone());
    SerialPortInfo { id, port: port.port_name, name, kind }
}

#[cfg(test)]
mod tests {
    use super::{DeviceErrorKind, SerialPortKind, describe, list_serial_ports, resolve, resolve_among};
    use serialport::{SerialPortInfo, SerialPortType, UsbPortInfo};

    fn usb(port_name: &str, serial_number: Option<&str>) -> SerialPortInfo {
        let usb = UsbPortInfo {
            vid: 0x2341,
            pid: 0x0043,
            serial_number: serial_number.map(Into::into),
            manufacturer: None,
            product: Some("Uno".into()),
        };
        SerialPortInfo { port_name: port_name.into(), port_type: SerialPortType::UsbPort(usb) }
    }

    fn ids(ports: &[SerialPortInfo]) -> Vec<String> {
        describe(ports.to_vec()).into_iter().map(|port| port.id).collect()
    }

    #[test]
    fn lists_without_opening_in_order() {
        let ports = list_serial_ports().unwrap();
        assert!(ports.windows(2).all(|w| w[0].id <= w[1].id));
    }

    /// A bare root folder has no `/sys`.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_system_without_a_list_is_an_error_and_no_panic() {
        let folder = tempfile::tempdir().unwrap();
        assert!(super::check_list(folder.path()).is_ok());
        let error = super::check_list(&folder.path().join("none")).unwrap_err();
        assert_eq!(error.kind(), DeviceErrorKind::Unavailable);
        assert!(error.message().contains("none") && error.message().contains("mount /sys"), "{error}");
    }

    #[test]
    fn a_port_is_shown_by_its_product() {
        let plain = SerialPortInfo { port_name: "/dev/ttyS0".into(), port_type: SerialPortType::Unknown };
        let described = describe(vec![usb("/dev/ttyACM0", Some("A 1")), plain]);
        assert_eq!(
            (described[1].id.as_str(), described[1].name.as_str()),
            ("serial:usb-2341-0043-A_1", "Uno")
        );
        assert_eq!(described[1].kind, SerialPortKind::Usb { vendor_id: 0x2341, product_id: 0x0043 });
        assert_eq!(
            (described[0].id.as_str(), described[0].port.as_str()),
            ("serial:/dev/ttyS0", "/dev/ttyS0")
        );
    }

    #[test]
    fn an_id_stays_where_it_can_and_is_the_name_where_it_cannot() {
        let (one, other) = (usb("/dev/ttyACM0", None), usb("/dev/ttyACM1", None));
        assert_eq!(ids(std::slice::from_ref(&one)), ["serial:usb-2341-0043"]);
        assert_eq!(ids(&[one, other]), ["serial:/dev/ttyACM0", "serial:/dev/ttyACM1"]);
        let (a, b) = (usb("/dev/ttyACM0", Some("a")), usb("/dev/ttyACM1", Some("b")));
        assert_eq!(ids(&[a, b]), ["serial:usb-2341-0043-a", "serial:usb-2341-0043-b"]);
        let (same, twin) = (usb("/dev/ttyACM0", Some("a")), usb("/dev/ttyACM1", Some("a")));
        assert_eq!(ids(&[same, twin]), ["serial:/dev/ttyACM0", "serial:/dev/ttyACM1"]);
        let (tty, cu) = (usb("/dev/tty.usbmodem1", Some("a")), usb("/dev/cu.usbmodem1", Some("a")));
        assert_eq!(ids(&[tty, cu]), ["serial:usb-2341-0043-a"]);
    }

    #[test]
    fn an_id_finds_its_port_wherever_it_is_plugged_in() {
        for port in ["/dev/ttyACM0", "/dev/ttyACM7"] {
            let ports = describe(vec![usb(port, Some("a")), usb("/dev/ttyACM3", Some("b"))]);
            assert_eq!(resolve_among("usb-2341-0043-a", ports).unwrap(), port);
        }
        let error = resolve_among("usb-2341-0043-c", describe(vec![usb("x", Some("a"))])).unwrap_err();
        assert_eq!(error.kind(), DeviceErrorKind::NotFound);
        assert!(error.message().contains("`serial:usb-2341-0043-c`"), "{error}");
        assert_eq!(resolve("serial:/dev/ttyUSB0").unwrap(), "/dev/ttyUSB0");
        assert_eq!(resolve("COM3").unwrap(), "COM3");
        assert_eq!(resolve("serial:usb-ffff-ffff-none").unwrap_err().kind(), DeviceErrorKind::NotFound);
    }
}
