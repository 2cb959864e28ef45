"""``viscofric web [STUDY.toml]``: the local page."""

from __future__ import annotations

from pathlib import Path

import click

from viscofric.cli.errors import told

_EPILOG = "The page is for you alone: the address holds a token, and nothing is asked of any other host."


@click.command(name="web", epilog=_EPILOG)
@click.argument("study", required=False, metavar="[STUDY]", type=click.Path(path_type=Path))
@click.option(
    "--port", default=8765, show_default=True, type=click.IntRange(0, 65535), help="Port; a free one if it is taken."
)
@click.option("--host", default="127.0.0.1", show_default=True, help="Address to serve at; others may reach it then.")
@click.option("--no-browser", is_flag=True, help="Only print the address.")
def command(study: Path | None, port: int, host: str, no_browser: bool) -> None:
    """Open a page in the browser: rubber, contact and friction without writing a line, until Ctrl-C.

    With a run file STUDY, the page opens with it and with copies of its data files.
    """
    with told():
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

        def tell(address: str, actual: int) -> None:
            if port not in (0, actual):
                click.echo(f"Note: port {port} is taken; the page is at {actual}.", err=True)
            click.echo(f"page {address}\nCtrl-C ends it.")

        serve(host, port, study=document, files=files, browser=not no_browser, tell=tell)
    click.echo("The page is closed.")
