//! `shagreen devices`: what there is to hold and to drive.

use serde_json::{Value, json};
use shagreen_device::output::{OutputKind, list_outputs};
use shagreen_device::serial::{SerialPortInfo, SerialPortKind, list_serial_ports};
use shagreen_device::stylus::{StylusKind, list_styluses};

use crate::cli::output;

/// Lists styluses, outputs and serial ports. Nothing is opened.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) {
    let styluses = list_styluses();
    let outputs = list_outputs();
    let serial = list_serial_ports().unwrap_or_else(|error| {
        output::warn(error.message());
        Vec::new()
    });
    let stylus_json = |stylus: &shagreen_device::stylus::StylusInfo| json!({"id": stylus.id, "name": stylus.name, "kind": stylus_kind(stylus.kind), "pressure": stylus.has_pressure});
    let output_json = |output: &shagreen_device::output::OutputInfo| json!({"id": output.id, "name": output.name, "kind": output_kind(output.kind), "default": output.is_default});
    let result = json!({
        "styluses": styluses.iter().map(stylus_json).collect::<Vec<_>>(),
        "outputs": outputs.iter().map(output_json).collect::<Vec<_>>(),
        "serial": serial.iter().map(serial_json).collect::<Vec<_>>(),
    });
    output::print(args.json, &result, || {
        let mut lines = vec!["Styluses:".to_owned()];
        lines.extend(styluses.iter().map(|stylus| line(&stylus.id, &stylus.name)));
        lines.push("Outputs (play --output ID):".to_owned());
        lines.extend(outputs.iter().map(|output| line(&output.id, &output.name)));
        lines.push("Serial ports (play --serial ID):".to_owned());
        lines.extend(serial.iter().map(|port| line(&port.id, &port.name)));
        lines.join("\n")
    });
}

fn line(id: &str, name: &str) -> String {
    format!("  {id}  {name}")
}

fn stylus_kind(kind: StylusKind) -> &'static str {
    match kind {
        StylusKind::Mouse => "mouse",
        _ => "other",
    }
}

fn output_kind(kind: OutputKind) -> &'static str {
    match kind {
        OutputKind::Null => "null",
        OutputKind::Audio => "audio",
        OutputKind::Serial => "serial",
        _ => "other",
    }
}

fn serial_json(port: &SerialPortInfo) -> Value {
    let (kind, usb) = match port.kind {
        SerialPortKind::Usb { vendor_id, product_id } => {
            ("usb", Some(json!({"vendor_id": vendor_id, "product_id": product_id})))
        }
        SerialPortKind::Pci => ("pci", None),
        SerialPortKind::Bluetooth => ("bluetooth", None),
        SerialPortKind::Unknown => ("unknown", None),
    };
    json!({"id": port.id, "port": port.port, "name": port.name, "kind": kind, "usb": usb})
}
