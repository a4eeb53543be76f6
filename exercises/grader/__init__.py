"""The machinery of the exercises.

Two sides talk over a pipe, in JSON text. What knows the answers stays on the grader's side:

    grader's side     check      what a check is: points, cases, calls, judge, explanation
                      judges     when an answer is right
                      marking    ask, judge, count points
                      report     what a student reads
                      recordings what an engine answered, where the engine is not installed
                      notebook   check("name") in a notebook: both sides in one process
                      shell      check a file: python -m exercises.grader.shell --unit 02 PATH
                      student    the shell's subprocess, seen from outside
    both sides        replies    which values may cross, and how they are written
    student's side    worker     looks functions up, calls them, sends back what they return
                      cells      runs a notebook's cells
                      state      what a question changes is put back
                  absent     stands in for packages that an exercise is to be solved without
                      ipython    IPython's syntax as plain Python
                      numba_cache  switched off: its files are pickles
                      serve      the loop of the shell's subprocess
    around it         sandbox    what a class's submissions run in: see there
"""
