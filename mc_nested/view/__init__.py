"""The live view: a run sets down what it does (board, publisher), another process reads and shows it (app)."""
