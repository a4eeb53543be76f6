"""Grading a class: a folder of notebooks in, scores and feedback out.

    python3 course.py grade FOLDER        or        python -m exercises.grader.classroom grade FOLDER

Nothing here runs, parses or draws what a student has written: bytes go to the sandbox, declared replies come
back.

    what comes in    submissions  whose notebook is where, and whether it may be read at all
                     collect      a download from Canvas or Moodle → submitted/<student>/<unit>/
                     roster       the instructor's own files: roster.csv, deadlines.csv, manual.csv
    grading          run          all of it, in order
                     batch        what is not finished yet
                     cases        the secret seed, and the hidden cases that were drawn from it
                     job          one submission: notebook in, result out, both JSON text
                     local        jobs on this machine
                     cluster      jobs on a Dask cluster
                     results      what is finished stays finished
    what goes out    told         what of a check's result its student may read
                     feedback     a page for each submission;  page: its frame;  curve: its plots
                     scores       points, penalties, manual points: scores.csv
                     exports      Gradescope, Canvas, Moodle
                     similarity   near-identical submissions;  fingerprint: the part that runs in the sandbox
                     overview     the instructor's page
    for students     release      the bundle without solutions;  released: its checks, read from data
    for all          files        names, tables, writing all of a file or nothing;  progress: how far it is
"""
