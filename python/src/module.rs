//! The module `pirca._native` and its functions, which `_native.pyi` describes.

use std::ffi::{CStr, OsString};
use std::path::PathBuf;
use std::ptr;

use pyo3::prelude::*;
use pyo3::types::{PyCFunction, PyDict, PyModule, PyTuple};
use pyo3::{IntoPyObjectExt, ffi};

use crate::{ask, table};

/// Of a module whose functions are added to it. The interpreter wants it to stay where it is.
static mut DEFINITION: ffi::PyModuleDef = ffi::PyModuleDef {
    m_base: ffi::PyModuleDef_HEAD_INIT,
    m_name: c"_native".as_ptr(),
    m_doc: c"The native part of pirca.".as_ptr(),
    m_size: -1,
    m_methods: ptr::null_mut(),
    m_slots: ptr::null_mut(),
    m_traverse: None,
    m_clear: None,
    m_free: None,
};

/// Called by the interpreter when the module is imported: the module, or null with an exception set.
///
/// # Safety
/// For the interpreter alone, which is attached to the thread and calls it once.
#[unsafe(no_mangle)]
#[allow(non_snake_case, reason = "the interpreter looks for this name")]
pub unsafe extern "C" fn PyInit__native() -> *mut ffi::PyObject {
    // SAFETY: as said above; a new module is a reference of our own, or null with an exception set.
    let (py, made) = unsafe {
        let py = Python::assume_attached();
        let made = ffi::PyModule_Create(ptr::addr_of_mut!(DEFINITION));
        (py, Bound::from_owned_ptr_or_err(py, made))
    };
    let filled = made.and_then(|module| {
        fill(module.cast::<PyModule>()?)?;
        Ok(module)
    });
    filled.map_or_else(
        |error| {
            error.restore(py);
            ptr::null_mut()
        },
        Bound::into_ptr,
    )
}

fn fill(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("VERSION", env!("CARGO_PKG_VERSION"))?;
    add(module, "ask", c"ask", |arguments| {
        let (given, hear): (Vec<OsString>, Bound<'_, PyAny>) = arguments.extract()?;
        ask::ask(&hear, given)?.into_py_any(arguments.py())
    })?;
    add(module, "command_line", c"command_line", |arguments| {
        let (given,): (Vec<OsString>,) = arguments.extract()?;
        arguments.py().detach(|| pirca::cli::main(given)).into_py_any(arguments.py())
    })?;
    add(module, "holds_run", c"holds_run", |arguments| {
        let (folder,): (PathBuf,) = arguments.extract()?;
        ask::holds_run(arguments.py(), &folder)?.into_py_any(arguments.py())
    })?;
    add(module, "table", c"table", |arguments| {
        let (path,): (PathBuf,) = arguments.extract()?;
        table::read(arguments.py(), path)
    })
}

/// Adds a function that takes its arguments by position.
fn add(
    module: &Bound<'_, PyModule>,
    name: &str,
    c_name: &'static CStr,
    function: fn(&Bound<'_, PyTuple>) -> PyResult<Py<PyAny>>,
) -> PyResult<()> {
    let called = move |arguments: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| function(arguments);
    module.add(name, PyCFunction::new_closure(module.py(), Some(c_name), None, called)?)
}
