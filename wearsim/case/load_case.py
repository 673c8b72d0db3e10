"""Reading a case: from a file or a mapping, with overrides, to a complete Case."""

from collections.abc import Callable, Sequence

from wearsim.case.model import Case
from wearsim.input.document import CaseSource, Document, is_whole_drive, read_document
from wearsim.input.mechanism_registry import mechanism_of
from wearsim.input.other_files import check_command
from wearsim.kernels.compiled import expect


def load_case(source: CaseSource, overrides: Sequence[str] = ()) -> Case:
    """Return the case of an input file, of its text or of a mapping with the same tables.

    Parameters
    ----------
    source : path, CaseText or mapping
        A TOML file, its text, or its tables as dictionaries (paths in it are then relative to
        the working directory).
    overrides : sequence of str
        ``table.key=VALUE``, applied before validation; VALUE is TOML, else a string.

    Returns
    -------
    Case
        Complete: every default filled in and named under ``assumptions``.

    Raises
    ------
    CaseError
        Everything that is wrong with the input, with file and line.

    Examples
    --------
    >>> case = load_case({
    ...     "format_version": 1,
    ...     "chain": {"designation": "16B-1"},
    ...     "sprocket": {"teeth": 20, "profile": "evolute"},
    ...     "load": {"power_kW": 3, "speed_rpm": 100},
    ...     "wear": {"condition": "hardened, oiled"},
    ... })
    >>> case.cycles_per_hour
    6000.0
    """
    document = read_document(source, overrides)
    check_command(document.data, document.faults.file, "life")
    if is_whole_drive(document.data):
        text = (
            "must be one [sprocket] here: a whole drive, [[sprocket]] twice, is for wearsim check, life, "
            "compare, report, maintain, lubricate, remaining, calibrate, sweep, uncertainty, loads, profile, "
            "export, animate and ui: run one of these (sweep for what matters and what is best, maintain for "
            "what is replaced when, lubricate for when it is oiled again, remaining and calibrate for "
            "readings of its chain), load it by load_drive in Python, or give the case of one sprocket, "
            "[sprocket] with drive.mate_teeth for the other one"
        )
        document.faults.add("sprocket", text)
        document.faults.check()
    # Models of tables and of geometry take time to import: only those of one mechanism are.
    mechanism = mechanism_of(document.data)
    read: Callable[[Document], Case] = mechanism.load("read")
    expect(mechanism.kernels)
    return read(document)
