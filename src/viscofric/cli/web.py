"""``viscofric web [STUDY.toml]``: the local page."""

from __future__ import annotations

from pathlib import Path

import click

from viscofric.cli.commands import as_command

_EPILOG = "The page is private: its address contains a token, and it connects to no other host."


@as_command("web", epilog=_EPILOG)
@click.argument("study", required=False, metavar="[STUDY]", type=click.Path(path_type=Path))
@click.option("--port", default=8765, type=click.IntRange(0, 65535), help="Port; if it is taken, a free one is used.")
@click.option("--host", default="127.0.0.1", help="Address to listen at; other machines may then connect.")
@click.option("--no-browser", is_flag=True, help="Print the address without opening a browser.")
def command(study: Path | None, port: int, host: str, no_browser: bool) -> None:
    """Open the local page in the browser: material, contact and friction, no coding needed. Ctrl-C ends it.

    With a run file STUDY, the page opens that study with copies of its data files.
    """
    from viscofric.web.server import is_local, serve

    document, files = None, None
    if study is not None:
        from viscofric.web.study_files import opened_study

        document, files = opened_study(study)
    if not is_local(host):
        click.echo(
            f"Warning: at {host}, other machines can reach the page, and the token goes to them unencrypted; "
            "whoever reads it on the way can read and change what you do here.",
            err=True,
        )

    def print_address(address: str, actual: int) -> None:
        if port not in (0, actual):
            click.echo(f"Note: port {port} is taken; the page is at {actual}.", err=True)
        click.echo(f"page {address}\nCtrl-C ends it.")

    serve(host, port, study=document, files=files, browser=not no_browser, on_start=print_address)
    click.echo("The page is closed.")
