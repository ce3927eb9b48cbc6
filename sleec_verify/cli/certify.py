"""``sleec-verify certify``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from sleec_verify.cli import exits, options
from sleec_verify.cli.inputs import one_ruleset
from sleec_verify.cli.output import note, write

if TYPE_CHECKING:
    from sleec_runtime.certificate.manifest import Required
    from sleec_runtime.model import Ruleset
    from sleec_verify.certificates.certification import Certificate
    from sleec_verify.encoding.scope import Scope
    from sleec_verify.results.finding import Severity


@click.command(
    "certify",
    short_help="Write or verify proofs of the results of check.",
    epilog="Example: sleec-verify certify rulesets/hospital-ward.sleec -o ward.certificate",
)
@options.paths(several=False)
@click.option("-o", "--output", metavar="DIR", type=options.PATH, help="Write the certificate to this folder.")
@click.option("--check", "checked", metavar="DIR", type=options.PATH, help="Verify this certificate of FILE.")
@options.scope(options.reading, options.domain, options.untimed, options.chains)
@options.fail_level
@click.option(
    "--sign",
    "private",
    metavar="KEY",
    type=options.PATH,
    help="Sign the certificate with this private Ed25519 key (PEM).",
)
@click.option(
    "--key",
    "public",
    metavar="PUB",
    type=options.PATH,
    help="With --check: reject the certificate unless it is signed with this key.",
)
@click.option(
    "--checker",
    metavar="PROGRAM",
    type=options.PATH,
    help="With --check: check the proofs with this program, for example check-lrat.",
)
@click.option("--force", is_flag=True, help="With -o: overwrite an existing certificate.")
@options.requirements("")
@options.output_format("full", "json")
@options.timeout
@options.max_size
@click.pass_context
def command(
    context: click.Context,
    path: str,
    output: str | None,
    checked: str | None,
    scope: Scope,
    fail_level: Severity,
    private: str | None,
    public: str | None,
    checker: str | None,
    force: bool,
    require_proved: bool,
    require_tied: bool,
    form: str,
) -> int:
    """Check the rules in FILE and write a certificate of the results: the clauses and their refutations (DIMACS, LRAT)
    for proved checks, the witnesses for refuted checks, and a manifest. With --check, verify a certificate: everything
    is computed again from the text of the rules.

    --require-proved and --require-tied apply when the certificate is written and whenever it is verified.

    The exit codes are the same as for `check`. If a certificate is rejected, the exit code is 2.
    """
    if (output is None) == (checked is None):
        raise click.UsageError("use -o DIR to write a certificate, or --check DIR to verify one")
    _refuse_stray(context, ("public", "checker") if checked is None else ("private", "force"))
    from sleec_runtime.certificate.manifest import Required

    required = Required(require_proved, require_tied)
    if output is not None:
        return _write(path, output, scope, fail_level, private, force, required, form)
    assert checked is not None
    return _check(path, checked, scope, fail_level, public, checker, required, form)


def _refuse_stray(context: click.Context, names: tuple[str, ...]) -> None:
    from click.core import ParameterSource

    for parameter in context.command.params:
        if parameter.name in names and context.get_parameter_source(parameter.name) != ParameterSource.DEFAULT:
            needed = "--check" if parameter.name in ("public", "checker") else "-o"
            raise click.UsageError(f"{parameter.opts[0]} needs {needed}")


def _write(
    path: str,
    output: str,
    scope: Scope,
    fail_level: Severity,
    private: str | None,
    force: bool,
    required: Required,
    form: str,
) -> int:
    from sleec_verify.certificates.certification import certify
    from sleec_verify.certificates.directory import check_free
    from sleec_verify.cli.progress import Progress
    from sleec_verify.report.certificate import render

    check_free(output, force)
    ruleset = one_ruleset(path, scope.reading, scope.domain)
    with Progress() as progress:
        progressing = progress.on(ruleset.source.path)
        made = certify(ruleset, scope.domain, scope.untimed, progressing, required, scope.chains)
        save(made, ruleset, output, private, force)
    write(render(form, ruleset, output, made.manifest, made.shown, None))
    return exits.code(made.results, fail_level)


def save(made: Certificate, ruleset: Ruleset, output: str, private: str | None = None, force: bool = False) -> None:
    """Write a certificate to the folder `output`, signed if there is a key.

    Raises CertificateRefused if a requirement does not hold. Then nothing is written.
    """
    from sleec_runtime.certificate.coverage import MANIFEST
    from sleec_runtime.certificate.signature import SIGNATURE
    from sleec_verify.certificates.checker import checker
    from sleec_verify.certificates.directory import write_folder
    from sleec_verify.certificates.signing import sign
    from sleec_verify.certificates.theory.oracle import built
    from sleec_verify.certificates.verification import check_certificate

    files = list(made.contents())
    if private is not None:
        files.append((SIGNATURE, sign(dict(files)[MANIFEST], private)))

    def accept(folder: str) -> None:
        if any(made.required):
            check_certificate(ruleset, folder, checker(), made.use, oracle=built())

    write_folder(output, files, force, accept)


def _check(
    path: str,
    checked: str,
    scope: Scope,
    fail_level: Severity,
    public: str | None,
    checker: str | None,
    required: Required,
    form: str,
) -> int:
    from sleec_runtime.certificate.coverage import Use
    from sleec_runtime.errors import CertificateRefused
    from sleec_verify.certificates.checker import checker as chosen
    from sleec_verify.certificates.theory.oracle import built
    from sleec_verify.certificates.verification import check_certificate
    from sleec_verify.cli.output import complain
    from sleec_verify.cli.progress import Progress
    from sleec_verify.report.certificate import render, render_refusal

    judge = chosen(checker)
    try:
        ruleset = _read(path, checked)
        with Progress() as progress:
            confirmed = check_certificate(
                ruleset,
                checked,
                judge,
                Use(scope.reading or ruleset.reading, scope.domain, scope.untimed, scope.chains),
                required,
                key=public,
                oracle=built(),
                progress=progress.on(ruleset.source.path),
            )
    except CertificateRefused as refusal:
        if form == "json":
            write(render_refusal(checked, refusal))
        else:
            complain(refusal)
        return exits.UNUSABLE
    if public is None and confirmed.signed:
        note("the certificate is signed, but its signature was not verified; use --key PUB")
    whole, shown = confirmed.manifest.whole, confirmed.shown
    write(render(form, confirmed.ruleset, checked, whole, shown, judge, confirmed.tied, confirmed.replayed))
    return exits.code((one.result for one in confirmed.shown), fail_level)


def _read(path: str, checked: str) -> Ruleset:
    """The rules in FILE. Raises CertificateRefused if FILE is no longer a ruleset since it was certified."""
    from sleec_runtime.certificate.coverage import read_manifest
    from sleec_runtime.errors import CertificateRefused, LanguageError

    try:
        return one_ruleset(path, None, None)
    except LanguageError as error:
        if read_manifest(checked).sha256 == error.source.sha256:
            raise
        raise CertificateRefused(
            [("ruleset-changed", f"the certificate is of another text; {error.source.path} is not a valid ruleset")],
            f"sleec-verify check {error.source.path}",
        ) from None
