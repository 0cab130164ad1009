"""The progress bar is for people at a terminal; a log or a pipe gets results and complaints only."""

import os
import pty
import subprocess
import termios

import pytest


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_pipe_gets_nothing(jobs, fresh, tools):
    done = fresh.command("run", "--jobs", jobs)
    assert (done.stderr, tools.summary(done)) == ("", (3, 0, 0))


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_terminal_is_shown_the_studies(jobs, fresh):
    ours, theirs = pty.openpty()
    termios.tcsetwinsize(theirs, (24, 80))
    run = fresh.start("-m", "rkverify", "run", "--jobs", jobs, stdout=subprocess.DEVNULL, stderr=theirs)
    os.close(theirs)
    shown = b""
    while True:
        try:
            piece = os.read(ours, 4096)
        except OSError:  # EIO: the other side is closed
            break
        if not piece:
            break
        shown += piece
    os.close(ours)
    assert run.wait(timeout=60) == 0
    assert b"/3 [" in shown
    assert all(name in shown for name in (b"gradients", b"phases", b"tents"))
