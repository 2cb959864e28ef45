"""What the page shows of results, as data: figures, numbers and tables; imported only by the processes that compute."""
