//! Check of glTF scenes with haptic materials: versions, indices, sizes of buffers, and the fields of the extension.
//!
//! It is no complete check of glTF: animations, skins, cameras and other extensions are not looked at.

use serde_json::Value;

use crate::first_faults::FirstFaults;
use crate::foreign_file::Found;
use crate::foreign_json::{ObjectFault, read_object};
use crate::haptic_maps::faults::{GltfFault, Scene, list_of, number_of};
use crate::haptic_maps::uri::name_of;

/// Name of the extension for haptic materials.
pub(super) const EXTENSION: &str = "MPEG_haptic_material";
/// Lists of textures in a haptic material.
const PROPERTIES: [&str; 6] =
    ["stiffness", "friction", "vibrotactileTexture", "temperature", "vibration", "custom"];
/// Types of a haptic texture. The texels of the third one are indices of signals.
const TYPES: [&str; 4] = ["High_Resolution", "Low_Resolution", "Reference", "Other"];
const REFERENCE: &str = TYPES[2];
/// Address with the data in itself.
const DATA: &str = "data:";

/// Why bytes are no glTF scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GltfError {
    /// The file is not JSON.
    #[error("{}", .found.instead_of("a glTF scene (.gltf)", "gltf"))]
    Foreign {
        /// What the file is.
        found: Found,
    },
    /// Not valid JSON.
    #[error("cannot read the glTF scene: {reason}; correct the file")]
    Damaged {
        /// The parser's message with its line and column.
        reason: String,
    },
}

impl From<ObjectFault> for GltfError {
    fn from(fault: ObjectFault) -> Self {
        match fault {
            ObjectFault::Foreign(found) => Self::Foreign { found },
            ObjectFault::Damaged(reason) => Self::Damaged { reason },
        }
    }
}

/// A scene, and what is wrong with it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CheckedGltf {
    /// Faults, at most a hundred of them.
    pub faults: Vec<GltfFault>,
    /// Number of all faults.
    pub n_faults: usize,
    /// Number of haptic materials.
    pub n_haptic_materials: usize,
    /// Files to which it refers.
    pub files: Vec<ReferredFile>,
}

/// File to which a scene refers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReferredFile {
    /// Field with the address.
    pub place: String,
    /// Name of the file, relative to the folder of the scene.
    pub name: String,
    /// Least length in bytes, for a buffer.
    pub least_bytes: u64,
}

/// Reads a scene and lists what is wrong with it. Whether the files to which it refers exist is up to the caller.
///
/// # Errors
/// See [`GltfError`].
pub fn check_gltf(bytes: &[u8]) -> Result<CheckedGltf, GltfError> {
    let root: Value = read_object(bytes)?;
    let mut scene = Scene::new(&root);
    if root.pointer("/asset/version").and_then(Value::as_str) != Some("2.0") {
        scene.add("asset.version", "it must be \"2.0\"; other versions of glTF are not known");
    }
    check_tree(&mut scene, &root);
    let haptic = root.get("extensions").and_then(|extensions| extensions.get(EXTENSION));
    let n_haptic_materials = haptic.map_or(0, |haptic| check_materials(&mut scene, haptic));
    check_meshes(&mut scene, n_haptic_materials);
    check_textures(&mut scene);
    check_buffers(&mut scene);
    let is_declared = list_of(&root, "extensionsUsed").iter().any(|name| name == EXTENSION);
    if n_haptic_materials > 0 && !is_declared {
        scene.add("extensionsUsed", format!("{EXTENSION} is used but not listed; add it"));
    }
    let files = files(&mut scene);
    let FirstFaults { first: faults, n: n_faults } = scene.faults;
    Ok(CheckedGltf { faults, n_faults, n_haptic_materials, files })
}

/// Checks scenes and nodes.
fn check_tree(scene: &mut Scene<'_>, root: &Value) {
    let (scenes, nodes, meshes) = (scene.list("scenes"), scene.list("nodes"), scene.list("meshes").len());
    scene.check_index(|| "scene".to_owned(), root.get("scene"), ("scenes", scenes.len()));
    let to_nodes = ("nodes", nodes.len());
    for (index, one) in scenes.iter().enumerate() {
        for (at, node) in list_of(one, "nodes").iter().enumerate() {
            scene.check_index(|| format!("scenes[{index}].nodes[{at}]"), Some(node), to_nodes);
        }
    }
    for (index, node) in nodes.iter().enumerate() {
        scene.check_index(|| format!("nodes[{index}].mesh"), node.get("mesh"), ("meshes", meshes));
        for (at, child) in list_of(node, "children").iter().enumerate() {
            scene.check_index(|| format!("nodes[{index}].children[{at}]"), Some(child), to_nodes);
        }
    }
}

/// Checks meshes, also their haptic materials.
fn check_meshes(scene: &mut Scene<'_>, n_haptic_materials: usize) {
    let to_accessors = ("accessors", scene.list("accessors").len());
    let to_materials = ("materials", scene.list("materials").len());
    for (index, mesh) in scene.list("meshes").iter().enumerate() {
        let place = format!("meshes[{index}]");
        let primitives = list_of(mesh, "primitives");
        if primitives.is_empty() {
            scene.add(&*place, "a mesh needs a primitive; add one");
        }
        for (at, primitive) in primitives.iter().enumerate() {
            let place = format!("{place}.primitives[{at}]");
            for (name, accessor) in
                primitive.get("attributes").and_then(Value::as_object).into_iter().flatten()
            {
                scene.check_index(|| format!("{place}.attributes.{name}"), Some(accessor), to_accessors);
            }
            scene.check_index(|| format!("{place}.indices"), primitive.get("indices"), to_accessors);
            scene.check_index(|| format!("{place}.material"), primitive.get("material"), to_materials);
        }
        let Some(haptic) = mesh.get("extensions").and_then(|extensions| extensions.get(EXTENSION)) else {
            continue;
        };
        let place = format!("{place}.extensions.{EXTENSION}.hapticMaterialIndex");
        // A missing index is none either.
        let at = haptic.get("hapticMaterialIndex").unwrap_or(&Value::Null);
        scene.check_index(|| place, Some(at), ("the haptic materials", n_haptic_materials));
    }
}

/// Checks the haptic materials, and returns their number.
fn check_materials(scene: &mut Scene<'_>, haptic: &Value) -> usize {
    let to_textures = ("textures", scene.list("textures").len());
    let materials = list_of(haptic, "materials");
    let of_materials = format!("extensions.{EXTENSION}.materials");
    if materials.is_empty() {
        scene.add(&*of_materials, "the extension needs a haptic material; add one");
    }
    for (index, material) in materials.iter().enumerate() {
        for property in PROPERTIES {
            for (at, texture) in list_of(material, property).iter().enumerate() {
                let place = format!("{of_materials}[{index}].{property}[{at}]");
                let index_of_texture = texture.pointer("/texture/index").unwrap_or(&Value::Null);
                scene.check_index(|| format!("{place}.texture.index"), Some(index_of_texture), to_textures);
                let kind = texture.get("type").and_then(Value::as_str).unwrap_or_default();
                if !TYPES.contains(&kind) {
                    scene.add(format!("{place}.type"), format!("it must be one of {}", TYPES.join(", ")));
                }
                if kind == REFERENCE && material.get("haptic").and_then(Value::as_u64).is_none() {
                    scene.add(
                        &*place,
                        "a texture of the type Reference needs the index `haptic` in its material",
                    );
                }
            }
        }
    }
    materials.len()
}

/// Checks textures and images.
fn check_textures(scene: &mut Scene<'_>) {
    let to_images = ("images", scene.list("images").len());
    let to_samplers = ("samplers", scene.list("samplers").len());
    for (index, texture) in scene.list("textures").iter().enumerate() {
        scene.check_index(|| format!("textures[{index}].source"), texture.get("source"), to_images);
        scene.check_index(|| format!("textures[{index}].sampler"), texture.get("sampler"), to_samplers);
    }
    let to_views = ("bufferViews", scene.list("bufferViews").len());
    for (index, image) in scene.list("images").iter().enumerate() {
        let place = format!("images[{index}]");
        if image.get("uri").is_some() == image.get("bufferView").is_some() {
            scene.add(&*place, "an image needs either `uri` or `bufferView`; give one of them");
        }
        scene.check_index(|| format!("{place}.bufferView"), image.get("bufferView"), to_views);
    }
}

/// Checks that buffer views lie in their buffers, and accessors in their buffer views.
fn check_buffers(scene: &mut Scene<'_>) {
    let (buffers, views) = (scene.list("buffers"), scene.list("bufferViews"));
    for (index, view) in views.iter().enumerate() {
        let place = format!("bufferViews[{index}]");
        let buffer = view.get("buffer").unwrap_or(&Value::Null);
        let at = scene.check_index(|| format!("{place}.buffer"), Some(buffer), ("buffers", buffers.len()));
        let end = number_of(view, "byteOffset", 0).saturating_add(number_of(view, "byteLength", u64::MAX));
        let length = at.map_or(u64::MAX, |at| number_of(&buffers[at], "byteLength", 0));
        if end > length {
            scene.add(
                &*place,
                format!("it ends beyond its buffer of {length} bytes; correct offset and length"),
            );
        }
    }
    for (index, accessor) in scene.list("accessors").iter().enumerate() {
        let place = format!("accessors[{index}]");
        let Some(bytes) = element_bytes(accessor) else {
            scene.add(&*place, "its `componentType` or `type` is unknown; correct it");
            continue;
        };
        let view = accessor.get("bufferView");
        let Some(at) =
            scene.check_index(|| format!("{place}.bufferView"), view, ("bufferViews", views.len()))
        else {
            continue;
        };
        let stride = number_of(&views[at], "byteStride", bytes);
        let before_last = number_of(accessor, "count", 0).saturating_sub(1).saturating_mul(stride);
        let end = number_of(accessor, "byteOffset", 0).saturating_add(before_last).saturating_add(bytes);
        if end > number_of(&views[at], "byteLength", 0) {
            scene.add(&*place, "it ends beyond its buffer view; correct offset, count or type");
        }
    }
}

/// Bytes of an element of an accessor; `None` for an unknown type.
fn element_bytes(accessor: &Value) -> Option<u64> {
    let of_component = match accessor.get("componentType")?.as_u64()? {
        5120 | 5121 => 1,
        5122 | 5123 => 2,
        5125 | 5126 => 4,
        _ => return None,
    };
    let n_components = match accessor.get("type")?.as_str()? {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" | "MAT2" => 4,
        "MAT3" => 9,
        "MAT4" => 16,
        _ => return None,
    };
    Some(of_component * n_components)
}

/// Files to which buffers and images refer.
fn files(scene: &mut Scene<'_>) -> Vec<ReferredFile> {
    let mut files = Vec::new();
    for list in ["buffers", "images"] {
        for (index, one) in scene.list(list).iter().enumerate() {
            let Some(uri) = one.get("uri").and_then(Value::as_str).filter(|uri| !uri.starts_with(DATA))
            else {
                continue;
            };
            let place = format!("{list}[{index}].uri");
            match name_of(uri) {
                Some(name) => {
                    files.push(ReferredFile { place, name, least_bytes: number_of(one, "byteLength", 0) });
                }
                None => {
                    scene
                        .add(place, "the address is damaged: `%` must be followed by two hexadecimal digits");
                }
            }
        }
    }
    files
}
