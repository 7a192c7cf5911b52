//! `shagreen devices`: lists input and output devices, and decodes pen descriptors and reports.

use std::path::PathBuf;

use serde_json::{Value, json};
use shagreen_device::audio_input::{InputInfo, list_inputs};
use shagreen_device::output::{OutputKind, list_outputs};
use shagreen_device::serial::{SerialPortInfo, SerialPortKind, list_serial_ports};
use shagreen_device::stylus::{StylusInfo, StylusKind, StylusList, list_styluses};

use crate::cli::devices_pens::{decode, list_descriptors};
use crate::cli::hid_files::{meters, size_mm};
use crate::cli::output;
use shagreen_studio::pen_backends::{access_id, backend_id, backend_name, provided};

/// Lists pens, outputs, audio inputs and serial ports without opening them, or decodes HID descriptors and reports of
/// pens.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Show what HID report descriptors declare. Each file contains raw bytes, the same bytes in hexadecimal, or a
    /// recording of hid-recorder or usbhid-dump.
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with_all = ["decode", "size_mm", "out"])]
    descriptor: Vec<PathBuf>,
    /// Decode the reports of a pen, recorded with hid-recorder or usbhid-dump, with its report descriptor. The
    /// descriptor can be omitted if the recording contains it.
    ///
    /// --json prints and --out writes the same samples: those with the pen in range; of several samples with the same
    /// time, only the last. t is in seconds from the first sample. x_mm and y_mm are in mm, rightward and downward from
    /// the upper left corner of the pen's active area.
    #[arg(long, value_names = ["DESCRIPTOR", "REPORTS"], num_args = 1..=2)]
    decode: Vec<PathBuf>,
    /// Width and height of the pen's active area in mm, such as 216x135, if the pen declares none or wrong ones.
    #[arg(long, value_name = "WxH", value_parser = size_mm, requires = "decode", allow_hyphen_values = true)]
    size_mm: Option<[f64; 2]>,
    /// Write the decoded stroke to a table (.csv) with the columns t_s, x_mm, y_mm, force_n (in N) and touching (0 or
    /// 1). If the pen declares no force, the column pressure (0 to 1) replaces force_n.
    #[arg(short, long, value_name = "OUT.csv", requires = "decode")]
    out: Option<PathBuf>,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    if !args.descriptor.is_empty() {
        return list_descriptors(&args.descriptor, args.json);
    }
    if !args.decode.is_empty() {
        return decode(&args.decode, meters(args.size_mm), args.out.as_deref(), args.json);
    }
    list(args.json);
    Ok(())
}

fn list(as_json: bool) {
    let StylusList { styluses, warning } = list_styluses();
    if let Some(warning) = warning {
        output::warn(warning.message());
    }
    let (outputs, inputs) = (list_outputs(), list_inputs());
    let serial = list_serial_ports().unwrap_or_else(|error| {
        output::warn(error.message());
        Vec::new()
    });
    let output_json = |output: &shagreen_device::output::OutputInfo| json!({"id": output.id, "name": output.name, "kind": output_kind(output.kind), "default": output.is_default});
    let result = json!({
        "styluses": styluses.iter().map(stylus_json).collect::<Vec<_>>(),
        "outputs": outputs.iter().map(output_json).collect::<Vec<_>>(),
        "inputs": inputs.iter().map(input_json).collect::<Vec<_>>(),
        "serial": serial.iter().map(serial_json).collect::<Vec<_>>(),
    });
    output::print(as_json, &result, || {
        let mut lines = vec!["Pens and mouse:".to_owned()];
        lines.extend(styluses.iter().flat_map(stylus_lines));
        lines.push("Outputs (play --output ID):".to_owned());
        lines.extend(outputs.iter().map(|output| line(&output.id, &output.name)));
        lines.push("Audio inputs (calibrate and latency --input ID):".to_owned());
        lines.extend(inputs.iter().map(|input| line(&input.id, &input.name)));
        lines.push("Serial ports (play --serial ID):".to_owned());
        lines.extend(serial.iter().map(|port| line(&port.id, &port.name)));
        lines.join("\n")
    });
}

fn line(id: &str, name: &str) -> String {
    format!("  {id}  {name}")
}

/// The stylus with its backend and what that provides, and what to do if it may not be read.
fn stylus_lines(stylus: &StylusInfo) -> Vec<String> {
    let (backend, provided) = (backend_name(stylus.backend), provided(&stylus.provides));
    let mut lines = vec![format!("{} ({backend}: {provided})", line(&stylus.id, &stylus.name))];
    lines.extend(stylus.advice.iter().flat_map(|advice| advice.lines()).map(|line| format!("    {line}")));
    lines
}

fn input_json(input: &InputInfo) -> Value {
    json!({"id": input.id, "name": input.name, "monitor_of": input.monitor_of})
}

fn stylus_json(stylus: &StylusInfo) -> Value {
    json!({
        "id": stylus.id,
        "name": stylus.name,
        "kind": stylus_kind(stylus.kind),
        "pressure": stylus.has_pressure,
        "vendor_id": stylus.product.map(|(vendor_id, _)| vendor_id),
        "product_id": stylus.product.map(|(_, product_id)| product_id),
        "backend": backend_id(stylus.backend),
        "provides": provided(&stylus.provides),
        "access": access_id(stylus.access),
        "advice": stylus.advice,
    })
}

fn stylus_kind(kind: StylusKind) -> &'static str {
    match kind {
        StylusKind::Mouse => "mouse",
        StylusKind::Window => "window",
        StylusKind::Pen => "pen",
        _ => "other",
    }
}

fn output_kind(kind: OutputKind) -> &'static str {
    match kind {
        OutputKind::Null => "null",
        OutputKind::Audio => "audio",
        OutputKind::Serial => "serial",
        OutputKind::HapticPen => "haptic_pen",
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
